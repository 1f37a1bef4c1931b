#pragma once
#include "scene/scene.h"

namespace airlight::bench {

/// scenes/sunroom.toml.
Scene sunroom();

/// scenes/sphere_in_fog.toml with Embree's visibility.
Scene sphere_in_fog();

/// A room with windows, curtains, tables and crockery, 270 000 triangles: as crowded as the
/// breakfast room on which renderers are often compared.
Scene crowded_room();

/// Its triangles as one Wavefront file, for loading.
std::string as_obj(const Scene& scene);

}  // namespace airlight::bench
