#pragma once
#include <cstddef>
#include <memory>

namespace airlight {

/// Memory with room for one element behind the last: Embree reads positions of 12 bytes by 16, and
/// takes them from where they are if those 4 more belong to somebody.
template <class T>
struct RoomBehind {
  using value_type = T;

  RoomBehind() = default;
  template <class U>
  RoomBehind(const RoomBehind<U>&) noexcept {}

  T* allocate(std::size_t count) { return std::allocator<T>().allocate(count + 1); }
  void deallocate(T* memory, std::size_t count) noexcept {
    std::allocator<T>().deallocate(memory, count + 1);
  }

  friend bool operator==(const RoomBehind&, const RoomBehind&) noexcept { return true; }
};

}  // namespace airlight
