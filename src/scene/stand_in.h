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

/// The scene file that a model without one stands for. Uses the camera and the lights of the model.
/// Where it has none, a room is seen from inside with the sun in its windows, anything else from
/// outside; both are filled or surrounded with fog.
class StandIn {
 public:
  /// Looks at the model as it stands at the start; `file` is its name.
  StandIn(const Model& model, const std::string& file);

  /// Camera, light and fog, and the model as the only object: with camera and lights as they stand
  /// in `now`, which is the same model at any time.
  std::string toml(const Model& now) const;

  /// What still holds of the assumptions after changes by path, in a sentence; empty if nothing
  /// does.
  std::string remark(const std::vector<Override>& changes) const;

 private:
  std::string sky_, camera_, sun_, rest_;  ///< of the file; camera and sun for want of the model's
  std::vector<Assumption> assumed_;
};

}  // namespace airlight
