#pragma once
#include "scene/scene.h"

namespace airlight {

/// The scene's camera and the size of its picture, for objects that are made from what it sees.
struct View {
  Camera camera;
  Resolution resolution;
};

}  // namespace airlight
