#include "scene/objects/mesh.h"

#include "error.h"

namespace airlight {

Parts MeshObject::build(const Cursor& at, const Files& files) const {
  const Cursor at_file = at.at_or_here("file");
  try {
    Model model = files.model(files.path(*file, at_file));
    return {std::move(model.objects), std::move(model.textures), std::move(model.remarks)};
  } catch (const Error& error) {
    at_file.complain(std::string("names a model that is not to be had: ") + error.what());
  }
}

}  // namespace airlight
