#include "loading.h"

#include <embree3/rtcore.h>
#include <tiny_obj_loader.h>

#include <filesystem>

#include "error.h"
#include "geometry/world.h"
#include "image/atomic_file.h"
#include "measure.h"
#include "render/kernel.h"
#include "scene/load_scene.h"
#include "scenes.h"

namespace airlight::bench {
namespace {

/// The least anyone could do: tinyobjloader's parse, and Embree's build over all its triangles.
void parse_and_build(const std::string& path) {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, path.c_str()))
    throw Error(path + ": " + error);
  const RTCDevice device = rtcNewDevice(nullptr);
  const RTCScene scene = rtcNewScene(device);
  for (const tinyobj::shape_t& shape : shapes) {
    const RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::size_t triangles = shape.mesh.indices.size() / 3;
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), triangles));
    for (std::size_t i = 0; i < 3 * triangles; ++i)
      indices[i] = unsigned(shape.mesh.indices[i].vertex_index);
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               attributes.vertices.data(), 0, 3 * sizeof(float),
                               attributes.vertices.size() / 3);
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    rtcReleaseGeometry(mesh);
  }
  rtcCommitScene(scene);
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}

}  // namespace

std::vector<Row> loading() {
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     ("airlight_bench_" + std::to_string(getpid()) + ".obj");
  write_text(path, as_obj(crowded_room()));
  double ratio = 0;
  try {
    ratio = median_ratio(
        7,
        [&] {
          const Scene scene = load_scene(path, {});
          const World world(scene, Visibility::embree);
        },
        [&] { parse_and_build(path); });
  } catch (...) {
    std::filesystem::remove(path);
    throw;
  }
  std::filesystem::remove(path);
  return {{"loading.obj_over_parse_and_build", ratio, "x", Must::at_most(1.5),
           kernel_for(InstructionSet::best).name}};
}

}  // namespace airlight::bench
