#include "interrupt.h"

#include <atomic>
#include <csignal>

namespace {

std::atomic<int> signal_received = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may write it");

constexpr int orderly_ends[] = {SIGINT, SIGTERM};

}  // namespace

Interrupt::Interrupt() {
  struct sigaction action = {};
  action.sa_handler = [](int number) {
    signal_received = number;
    for (const int other : orderly_ends) std::signal(other, SIG_DFL);
  };
  action.sa_flags = SA_RESTART;
  for (const int number : orderly_ends) sigaction(number, &action, nullptr);
}

Interrupt::~Interrupt() {
  for (const int number : orderly_ends) std::signal(number, SIG_DFL);
}

int Interrupt::received() noexcept { return signal_received; }
