#pragma once
#include <airlight/medium.h>

#include <optional>
#include <span>
#include <string>

namespace airlight {

/// Why these media cannot lie side by side, naming them by their indices: they overlap by more than
/// rounding, one is not convex, or there are more of them than a ray has room for. None: they can.
std::optional<std::string> cannot_be_joined(std::span<const Medium> media);

}  // namespace airlight
