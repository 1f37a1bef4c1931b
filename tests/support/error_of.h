#pragma once
#include <string>

#include "error.h"

namespace airlight::test {

/// What is thrown in words; "" if nothing is.
template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace airlight::test
