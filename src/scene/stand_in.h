#pragma once
#include <string>

#include "scene/models/model.h"

namespace airlight {

/// The scene file that a model without one stands for.
struct StandIn {
  std::string toml;     ///< camera, light and fog, and the model as its only object
  std::string assumed;  ///< what the model left open, a sentence; empty if nothing
};

/// Uses the camera and the lights of the model. Where it has none, a room is seen from inside with
/// the sun in its windows, anything else from outside; both are filled or surrounded with fog.
StandIn stand_in_for(const Model& model, const std::string& file);

}  // namespace airlight
