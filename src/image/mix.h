#pragma once
#include <array>
#include <string>
#include <vector>

#include "image/picture.h"

namespace airlight {

/// What the light of a group is multiplied by.
struct Gain {
  std::string group;
  std::array<float, 3> factor{1, 1, 1};  ///< R, G, B
};

/// The light groups of a picture: what it has three layers of, "sun", "sun.in_scatter" and
/// "sun.surface".
std::vector<std::string> light_groups(const Picture& picture);

/// A rendered picture under other lights: every layer of a group times its gain; beauty, in_scatter
/// and surface as sums over all groups; the shadows on holdouts, what shows of the background there
/// and the alpha as the light of all groups makes them. Layers that know no light stay, but the
/// standard error is left out: it is not known by group. Throws Error for a group that is not
/// there.
Picture mix(const Picture& picture, const std::vector<Gain>& gains);

}  // namespace airlight
