#pragma once
#include <variant>

#include "forms/difference.h"
#include "forms/monte_carlo.h"
#include "forms/ratio.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Every form there is. To add one: its file in forms/ and its name here.
using Forms = std::variant<MonteCarlo, Ratio, Difference>;

static_assert(Form<MonteCarlo> && Form<Ratio> && Form<Difference>);

}  // namespace airlight::inline AIRLIGHT_ISA
