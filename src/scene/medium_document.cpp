#include "scene/medium_document.h"

#include "scene/ways.h"

namespace airlight {

Medium MediumDocument::medium(const Cursor& at, const Files& files) const {
  Medium medium;
  switch (
      way_taken(at, {{"sigma_s", "sigma_a"}, {"albedo", "sigma_t"}, {"albedo", "visibility"}})) {
    case 0:
      medium.sigma_s = *sigma_s;
      medium.sigma_t = *sigma_s + *sigma_a;
      break;
    case 1:
      medium.sigma_s = *albedo * *sigma_t;
      medium.sigma_t = *sigma_t;
      break;
    default:
      medium.sigma_t = Rgb<double>(3.912 / *visibility);  // Koschmieder: ln 50
      medium.sigma_s = *albedo * medium.sigma_t;
  }
  medium.emission = emission;
  medium.phase = phase;
  medium.shape = shape_of(*shape, at.at_or_here("shape"), files);
  return medium;
}

}  // namespace airlight
