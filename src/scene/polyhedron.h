#pragma once
#include <airlight/shapes/convex.h>

#include <array>
#include <vector>

namespace airlight {

/// What is inside all planes [nx, ny, nz, h], at most `most_planes` of them: n·x <= h, n of any
/// length but 0. Planes that touch nothing are dropped. Throws Error for a polyhedron that is
/// empty, flat, endless, or has more than Convex::max_faces faces.
Convex polyhedron_inside(const std::vector<std::array<double, 4>>& planes);

inline constexpr std::size_t most_planes = 256;

/// The convex hull of points, at most `most_hull_points` of them. What lies within 1e-6 of its size
/// from a face belongs to the face. Throws Error as above.
Convex hull_of(const std::vector<Vec3<double>>& points);

inline constexpr std::size_t most_hull_points = 256;

/// Whether the insides of two polyhedra meet, by more than a millionth of the smaller one's size.
bool overlap(const Convex& a, const Convex& b);

}  // namespace airlight
