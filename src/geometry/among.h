#pragma once

namespace airlight {

/// Which of a scene's objects are there.
enum class Among { all, holdouts };

}  // namespace airlight
