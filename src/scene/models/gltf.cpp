#include "scene/models/gltf.h"

#include <fmt/format.h>

#include "error.h"
#include "scene/models/gltf/primitives.h"

namespace airlight {

Model load_gltf(const std::filesystem::path& path) {
  const gltf::Document document = gltf::read_document(path);
  const std::vector<gltf::PlacedNode> nodes = gltf::place_nodes(document);
  Model model;
  const auto materials = gltf::convert_materials(document, model.textures);
  gltf::Collector collector(document, materials);
  for (const gltf::PlacedNode& node : nodes) collector.add(node);
  model.objects = collector.finish(model.remarks);
  if (model.objects.empty())
    throw Error(fmt::format("{}: no triangles in its scene; a mesh of triangles, strips or fans",
                            path.string()));
  model.camera = gltf::find_camera(document, nodes);
  model.lights = gltf::find_lights(document, nodes, model.remarks);
  return model;
}

}  // namespace airlight
