#pragma once
#include <variant>

#include "scene/objects/blinds.h"
#include "scene/objects/box.h"
#include "scene/objects/boxes.h"
#include "scene/objects/depth_image.h"
#include "scene/objects/disc.h"
#include "scene/objects/mesh.h"
#include "scene/objects/rectangle.h"
#include "scene/objects/rose_window.h"
#include "scene/objects/shattered_wall.h"
#include "scene/objects/sphere.h"
#include "scene/objects/tree.h"
#include "scene/objects/wall.h"

namespace airlight {

/// Every kind of object a scene file can name. To add one: its file in objects/ and its name here.
using Objects = std::variant<SphereObject, BoxObject, BoxesObject, RectangleObject, DiscObject,
                             WallObject, ShatteredWallObject, BlindsObject, RoseWindowObject,
                             TreeObject, MeshObject, DepthImageObject>;

}  // namespace airlight
