#pragma once
#include <cmath>

namespace airlight {

/// How linear light is brought into [0, 1] for a display.
enum class ToneMap {
  none,    ///< clipped at 1
  filmic,  ///< `filmic`: dark tones gain contrast, bright ones roll off and never clip hard
};

/// From linear light to what a display shows.
struct Display {
  float exposure = 0;  ///< in stops: light is multiplied by 2^exposure first
  ToneMap tone_map = ToneMap::none;
};

/// Narkowicz's fit of the ACES output transform, per channel, for x >= 0; 0.18 becomes 0.267, 1
/// becomes 0.804. K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2015.
inline float filmic(float x) {
  x = std::fmin(x, 1e4F);  // the quotient is flat from here, and its squares must not overflow
  return std::fmin((x * (2.51F * x + 0.03F)) / (x * (2.43F * x + 0.59F) + 0.14F), 1.0F);
}

/// Linear light in [0, 1] after exposure and tone map; below 0 counts as 0.
inline float displayed(float light, const Display& display) {
  const float x = std::fmax(light * std::exp2(display.exposure), 0.0F);
  return std::fmin(display.tone_map == ToneMap::filmic ? filmic(x) : x, 1.0F);
}

}  // namespace airlight
