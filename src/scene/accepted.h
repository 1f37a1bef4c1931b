#pragma once
#include <airlight/describe.h>

#include <string>
#include <vector>

namespace airlight {

/// What a parameter takes, in words: for errors and for the reference page.

/// "a number in (-1, 1)", "a whole number of at least 1", "a number above 0 m".
std::string accepted_number(const Range& range, const char* unit, bool whole);

/// "[x, y, z], each in [0, 1]".
std::string accepted_numbers(const std::string& form, const Range& range, const char* unit);

/// "box, gaussian, tent": in alphabetical order.
std::string accepted_words(std::vector<std::string> words);

}  // namespace airlight
