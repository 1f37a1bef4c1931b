#include "scene/objects/mesh.h"

#include "error.h"

namespace airlight {

Parts MeshObject::build(const Cursor& at, const Files& files) const {
  try {
    Model model = files.model(*file);
    return {std::move(model.objects), std::move(model.textures), std::move(model.remarks)};
  } catch (const Error& error) {
    at.at_or_here("file").complain(std::string("names a model that is not to be had: ") +
                                   error.what());
  }
}

}  // namespace airlight
