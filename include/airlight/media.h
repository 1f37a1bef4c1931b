#pragma once
#include <span>

#include "estimator.h"
#include "joined.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Calls use(medium, space) with the space of media side by side and the first of them; null
/// without any. In a space of several, the space itself knows each one's coefficients.
template <class Use>
void with_space(std::span<const Medium> media, Use&& use) {
  if (media.empty())
    use(static_cast<const Medium*>(nullptr), Unbounded::Space{});
  else if (media.size() == 1)
    std::visit([&](const Shape auto& shape) { use(&media[0], shape.space()); }, media[0].shape);
  else
    use(&media[0], Joined(media));
}

/// The stretches of a ray, in the space's coordinates, in its media.
template <Real F, class Space>
auto stretches_of(const Medium* medium, const Space& space, const LocalRay<F>& local) noexcept {
  if constexpr (InPieces<Space>) {
    return space.stretches(local, *medium);
  } else {
    Stretches<F, 1, Medium> result;
    result.media = medium;
    if (medium) result.add(space.clip(local));
    return result;
  }
}

}  // namespace airlight::inline AIRLIGHT_ISA
