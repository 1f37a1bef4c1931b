#pragma once
#include <stdexcept>

namespace airlight {

/// Something the user can mend: one line that says where, what was found and what is accepted.
/// Everything in src/ reports bad input with it; only programs catch it.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace airlight
