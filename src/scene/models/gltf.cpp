#include "scene/models/gltf.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "error.h"
#include "scene/models/gltf/motion.h"
#include "scene/models/gltf/primitives.h"

namespace airlight {
namespace {

/// A glTF file in memory, its textures decoded.
struct GltfFile {
  gltf::Document document;
  std::vector<std::string> remarks;
  std::vector<Texture> textures;
  std::vector<gltf::GltfMaterial> materials;
  gltf::Motion motion;

  explicit GltfFile(const std::filesystem::path& path)
      : document(gltf::read_document(path)),
        materials(gltf::convert_materials(document, textures)),
        motion(document, remarks) {
    if (!document.extensions_left_out.empty())
      remarks.push_back(fmt::format("extensions of the file are left out ({})",
                                    fmt::join(document.extensions_left_out, ", ")));
  }

  /// Everything but the textures, at a time in seconds.
  Model model(double seconds) const {
    const std::vector<gltf::PlacedNode> nodes = gltf::place_nodes(document, motion.poses(seconds));
    Model model;
    model.remarks = remarks;
    gltf::Collector collector(document, materials, nodes);
    for (const gltf::PlacedNode& node : nodes) collector.add(node);
    model.objects = collector.finish(model.remarks);
    if (model.objects.empty())
      throw Error(fmt::format("{}: no triangles in its scene; a mesh of triangles, strips or fans",
                              document.file));
    model.camera = gltf::find_camera(document, nodes, model.remarks);
    model.lights = gltf::find_lights(document, nodes, model.remarks);
    return model;
  }
};

}  // namespace

std::variant<Model, MovingModel> load_gltf(const std::filesystem::path& path) {
  const auto file = std::make_shared<GltfFile>(path);
  if (file->motion.empty()) {
    Model model = file->model(0);
    model.textures = std::move(file->textures);
    return model;
  }
  return [file](double seconds) {
    Model model = file->model(seconds);
    model.textures = file->textures;
    return model;
  };
}

}  // namespace airlight
