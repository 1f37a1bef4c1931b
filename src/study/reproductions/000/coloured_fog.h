#pragma once
#include "scene/scene.h"

namespace airlight::paper_000 {

/// Configuration B of the black ball in fog that dims red, green and blue differently: σ_t = (0.3,
/// 1, 3) /m; every channel scatters alike.
Scene coloured_fog();

/// The squared errors of `rewv` and `mcwvds` in each channel of that scene, against the exact
/// picture.
struct ChannelErrors {
  Rgb<double> rewv, mcwvds;  ///< MSE, mean over the seeds

  Rgb<double> ratio() const { return {rewv.r / mcwvds.r, rewv.g / mcwvds.g, rewv.b / mcwvds.b}; }
};
ChannelErrors errors_in_coloured_fog(int spp, int seeds);

}  // namespace airlight::paper_000
