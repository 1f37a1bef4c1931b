#pragma once
#include <mutex>

namespace airlight {

/// A mutex that two threads take in turns: who waits comes before who has just let it go.
class FairMutex {
 public:
  void lock() {
    const std::scoped_lock turn(turn_);
    held_.lock();
  }
  void unlock() { held_.unlock(); }

 private:
  std::mutex turn_, held_;
};

}  // namespace airlight
