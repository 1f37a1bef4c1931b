#pragma once
#include <string>

namespace airlight {

/// Scene files of scenes/ that reproductions show, as text in the library: so that they are found
/// wherever it runs.
extern const std::string sunroom_toml;
extern const std::string destruction_toml;
extern const std::string gallery_toml;

}  // namespace airlight
