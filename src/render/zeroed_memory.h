#pragma once
#include <sys/mman.h>

#include <new>

namespace airlight {

/// Memory that is zero without being written: the system hands out fresh pages and zeroes each when
/// it is first touched, by the worker that renders there and not by the one that asks for it. Large
/// pages where it has them: the system serves a process's page faults one after the other, for
/// which the workers would wait.
template <class T>
struct ZeroedMemory {
  using value_type = T;

  T* allocate(std::size_t count) {
    const std::size_t size = mapped(count);
    void* memory =
        ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    ::madvise(memory, size, MADV_HUGEPAGE);
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) noexcept { ::munmap(memory, mapped(count)); }
  void construct(T*) noexcept {}  // it is zero
  void construct(T* place, T value) noexcept { *place = value; }

  friend bool operator==(const ZeroedMemory&, const ZeroedMemory&) noexcept { return true; }

 private:
  /// Bytes of so many T: whole large pages, for only such a request begins at one, unless most of a
  /// page would be left over.
  static constexpr std::size_t mapped(std::size_t count) noexcept {
    constexpr std::size_t large = std::size_t(2) << 20;
    const std::size_t size = count * sizeof(T);
    return size < large / 4 ? size : (size + large - 1) / large * large;
  }
};

}  // namespace airlight
