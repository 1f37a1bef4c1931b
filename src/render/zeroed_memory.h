#pragma once
#include <cstdlib>
#include <new>

namespace airlight {

/// Memory that is zero without being written: a system that hands out fresh pages zeroes each when it
/// is first touched, by the worker that renders there and not by the one that asks for it.
template <class T>
struct ZeroedMemory {
  using value_type = T;

  T* allocate(std::size_t count) {
    void* memory = std::calloc(count, sizeof(T));
    if (!memory) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) noexcept { std::free(memory); }
  void construct(T*) noexcept {}  // it is zero
  void construct(T* place, T value) noexcept { *place = value; }

  friend bool operator==(const ZeroedMemory&, const ZeroedMemory&) noexcept { return true; }
};

}  // namespace airlight
