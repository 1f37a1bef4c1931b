#pragma once
#include <airlight/math/vec.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace airlight::test {

/// `value` of as many things as F has lanes, from the first on; the last one fills up the packet.
template <Real F, class T, class Value>
F gather(const std::vector<T>& all, std::size_t first, Value&& value) {
  Scalar<F> scalars[lanes<F>];
  for (int i = 0; i < lanes<F>; ++i)
    scalars[i] =
        Scalar<F>(std::invoke(value, all[std::min(first + std::size_t(i), all.size() - 1)]));
  return load<F>(scalars);
}
template <Real F, class T, class Value>
Vec3<F> gather3(const std::vector<T>& all, std::size_t first, Value&& value) {
  const auto component = [&](int k) {
    return gather<F>(all, first, [&](const T& one) { return std::invoke(value, one)[k]; });
  };
  return {component(0), component(1), component(2)};
}

}  // namespace airlight::test
