#pragma once
#include <airlight/closed_mesh.h>

#include <memory>
#include <span>

namespace airlight {

/// The body that triangles close off. Corners at the same place count as one; triangles may turn
/// either side out; of shells inside each other every second one bounds a hole. Throws Error with
/// what keeps it from being a body: an open edge, triangles that cross, or so many of them that a
/// plane may cut more than a ray has room for.
std::shared_ptr<const ClosedMesh> close_mesh(
    std::span<const ClosedMesh::Point> points,
    std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace airlight
