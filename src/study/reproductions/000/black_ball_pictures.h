#pragma once
#include <string>

#include "study/comparison.h"
#include "study/reproduction.h"
#include "study/reproductions/000/black_ball.h"

namespace airlight::paper_000 {

/// Shows the picture of each estimator, its distance from the reference, and the reference, which
/// goes by the given name.
void show_pictures(Reproduced& out, const Configuration& configuration,
                   const Comparison& comparison, const std::string& reference);

}  // namespace airlight::paper_000
