#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"
#include "study/reproduction.h"
#include "study/reproductions/000/black_ball.h"

namespace airlight::paper_000 {

/// A scene seen from one place, in the setting of the paper: parallel light, grey fog, and all
/// samples of a pixel on the ray through its centre.
struct View {
  std::string name;   ///< in words
  std::string stem;   ///< of its pictures' names
  std::string about;  ///< where it is and what of it was made up, in sentences
  Scene scene;
};

/// The scene in that setting, its picture `width` pixels wide.
View view(std::string name, std::string stem, std::string about, Scene scene, int width);

/// The sunroom as it is: most of what the camera sees is lit far from it, in thin fog.
View from_the_dark(int width);

/// The sunroom beside its windows, in thicker fog: what is lit is near.
View in_the_light(int width);

/// The black ball in fog of figure 6, its shadow found by rays through Embree.
View ball_in_fog(const Configuration& configuration, int width);

/// The scene that the user gave.
View given_view(const Reproduced& out, int width);

}  // namespace airlight::paper_000
