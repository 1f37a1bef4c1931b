#pragma once
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "error.h"

namespace airlight::bench {

/// Starts a piece of work in a process of its own, a fork of this one. Only before threads have
/// started.
template <class Work>
pid_t start(Work&& work) {
  const pid_t child = fork();
  if (child < 0) throw Error("a process cannot be started");
  if (child > 0) return child;
  try {
    work();
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

/// Waits for a process and gives what it used. Throws Error if it failed.
inline rusage finish(pid_t child) {
  int status = 1;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || status != 0)
    throw Error("a render in a process of its own failed");
  return usage;
}

}  // namespace airlight::bench
