#pragma once
#include <string>
#include <vector>

#include "scene/document.h"
#include "scene/models/model.h"

namespace airlight {

/// Something that a model left open, and what was taken for it.
struct Assumption {
  std::vector<std::string> paths;  ///< of the values that say so, in the stand-in's scene file
  std::string text;                ///< such as "a sun at elevation 40"
};

/// The scene file that a model without one stands for.
struct StandIn {
  std::string toml;  ///< camera, light and fog, and the model as its only object
  std::vector<Assumption> assumed;

  /// What still holds after changes by path, in a sentence; empty if nothing does.
  std::string remark(const std::vector<Override>& changes) const;
};

/// Uses the camera and the lights of the model. Where it has none, a room is seen from inside with
/// the sun in its windows, anything else from outside; both are filled or surrounded with fog.
StandIn stand_in_for(const Model& model, const std::string& file);

}  // namespace airlight
