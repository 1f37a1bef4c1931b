#pragma once

namespace airlight {

/// The version of this library, as in "0.1.0".
const char* version();

}  // namespace airlight
