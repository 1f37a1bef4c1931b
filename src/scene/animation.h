#pragma once
#include <airlight/describe.h>

#include <optional>
#include <string>
#include <vector>

#include "scene/document.h"
#include "scene/required.h"

namespace airlight {

enum class Interpolation { linear, smooth, step };

template <>
inline constexpr Word<Interpolation> words<Interpolation>[] = {
    {"linear", Interpolation::linear, "straight from key to key"},
    {"smooth", Interpolation::smooth,
     "eases out of the first key and into the last, and does not leave the range of two keys "
     "between them"},
    {"step", Interpolation::step, "stays until the next key; also for words"},
};

/// A value of the scene that changes, as a file says it: keys, which are moments and what the value
/// is then. Before the first key and after the last it is held.
struct AnimationDocument {
  Required<std::string> path;
  std::optional<std::vector<double>> frames;
  std::optional<std::vector<double>> seconds;
  Required<std::vector<Value>> values;
  Interpolation interpolation = Interpolation::linear;

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using D = AnimationDocument;
    field("path", &D::path, unit::none, any_number(),
          "what changes: a number, such as objects.0.translate.1, or a whole list of them, such as "
          "camera.position");
    field("frames", &D::frames, unit::none, any_number(),
          "when the keys are, in ascending order; instead of seconds");
    field("seconds", &D::seconds, unit::second, any_number(),
          "the same in seconds after frame 0; instead of frames");
    field("values", &D::values, unit::none, any_number(), "one for each key");
    field("interpolation", &D::interpolation, unit::none, any_number(), "the way between keys");
  }
};

/// Replaces what the document's [[animation]] tables name by the values of its frame, which is
/// render.frame. Each carries the place of its key, so that a reader's error points there. Throws
/// Error for keys that make no sense.
void animate(Value& document);

}  // namespace airlight
