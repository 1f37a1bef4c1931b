#include "interrupt.h"

#include <atomic>
#include <csignal>

namespace {

std::atomic<int> signal_received = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may write it");

/// A signal that asks for an end, and what it did before.
struct End {
  int signal;
  struct sigaction before = {};

  /// A job in the background of a script, say, ignores the script's Ctrl-C.
  bool is_ignored() const { return before.sa_handler == SIG_IGN; }
};

End ends[] = {{SIGINT}, {SIGTERM}, {SIGHUP}};

}  // namespace

Interrupt::Interrupt() {
  struct sigaction action = {};
  action.sa_handler = [](int number) {
    signal_received = number;
    for (const End& end : ends)
      if (!end.is_ignored()) std::signal(end.signal, SIG_DFL);
  };
  action.sa_flags = SA_RESTART;
  for (End& end : ends) sigaction(end.signal, nullptr, &end.before);
  for (const End& end : ends)
    if (!end.is_ignored()) sigaction(end.signal, &action, nullptr);
}

Interrupt::~Interrupt() {
  for (const End& end : ends) sigaction(end.signal, &end.before, nullptr);
}

int Interrupt::received() noexcept { return signal_received; }
