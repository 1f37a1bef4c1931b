#pragma once
#include <variant>

#include "scene/objects/box.h"
#include "scene/objects/mesh.h"
#include "scene/objects/rectangle.h"
#include "scene/objects/sphere.h"

namespace airlight {

/// Every kind of object a scene file can name. To add one: its file in objects/ and its name here.
using Objects = std::variant<SphereObject, BoxObject, RectangleObject, MeshObject>;

}  // namespace airlight
