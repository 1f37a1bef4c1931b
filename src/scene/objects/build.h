#pragma once
#include <array>

#include "scene/scene.h"

namespace airlight {

/// Adds the parallelogram corner, corner + u, corner + u + v, corner + v, as two triangles that
/// face along u × v; texture coordinates run from 0 to 1 along u and v.
void add_parallelogram(Mesh& mesh, Vec3<double> corner, Vec3<double> u, Vec3<double> v);

/// Adds the six sides of a box, facing out; each carries the whole texture.
void add_box(Mesh& mesh, Vec3<double> min, Vec3<double> max);

}  // namespace airlight
