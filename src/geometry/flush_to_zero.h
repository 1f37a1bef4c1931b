#pragma once
#include <pmmintrin.h>
#include <xmmintrin.h>

namespace airlight {

/// While it lives, this thread's arithmetic takes numbers below 1.2e-38 for 0, as Embree asks of
/// threads that trace rays: such numbers would cost a hundred cycles each. Every worker thread
/// holds one.
class FlushToZero {
 public:
  FlushToZero() noexcept : before_(_mm_getcsr()) {
    _mm_setcsr(before_ | _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON);
  }
  ~FlushToZero() { _mm_setcsr(before_); }
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
  unsigned before_;
};

}  // namespace airlight
