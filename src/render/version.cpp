#include "render/version.h"

namespace airlight {

const char* version() { return AIRLIGHT_VERSION; }

}  // namespace airlight
