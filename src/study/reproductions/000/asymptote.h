#pragma once
#include "study/reproductions/000/black_ball.h"

namespace airlight::paper_000 {

/// What the squared error of the Monte Carlo form tends to, times the square of the number of
/// jittered samples:
///
///     MSE · N² → k² / 6 · mean over pixels of Σ_j (e(t_j) / p(t_j))²
///
/// t_j: where shadows begin and end on a pixel's ray, e: transmittance of the whole way, p: density
/// of the placement, k: sigma_s times phase function times irradiance.
struct Asymptotes {
  double whole_volume = 0, equidistant = 0, distance = 0;  ///< [(W/(m2 sr))2]
};
Asymptotes asymptotes(const Configuration& configuration);

}  // namespace airlight::paper_000
