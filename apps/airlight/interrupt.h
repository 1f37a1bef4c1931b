#pragma once

/// While it lives, the first Ctrl-C (SIGINT), SIGTERM or end of the terminal (SIGHUP) asks for an
/// orderly end and the second one ends the program at once. A signal that was ignored before stays
/// ignored.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// The signal that came, or 0.
  static int received() noexcept;
};
