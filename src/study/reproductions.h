#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "study/reproduction.h"

namespace airlight {

/// Every reproduction there is. To add one: its file in reproductions/ and its two lines in
/// reproductions.cpp.
std::span<const Reproduction> reproductions();

/// Those that a name means: the one with this name, or all below it ("000" means every "000/…").
/// Throws Error with the accepted names where there is none.
std::vector<const Reproduction*> reproductions_named(std::string_view name);

/// Throws Error with the names of those that take a scene of the user's if one of these does not.
void check_take_scene(std::span<const Reproduction* const> chosen);

}  // namespace airlight
