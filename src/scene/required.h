#pragma once
#include <optional>

namespace airlight {

/// A described member that has no sensible default: a file must give it.
template <class T>
struct Required {
  std::optional<T> value;

  const T& operator*() const { return *value; }
  const T* operator->() const { return &*value; }
};

}  // namespace airlight
