#pragma once
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "folder.h"

namespace airlight::test {

inline std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Waits until something holds; the limit is far beyond what a busy machine needs.
inline bool wait_for(const std::function<bool()>& holds) {
  for (int i = 0; i < 6000; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// How a run of the program ended.
struct Outcome {
  int status = -1;  ///< the exit status; 1000 + the number of a signal that ended it
  std::string out, err;
};

/// What may be done beside a run.
struct Beside {
  std::function<void()> before = [] {};              ///< in the new process, before the program
  std::function<void(pid_t)> during = [](pid_t) {};  ///< here, while it runs
};

/// Runs the program of this build and waits for its end.
inline Outcome run(const std::vector<std::string>& arguments, const Beside& beside = {}) {
  const Folder folder;
  const std::string out = folder / "out", err = folder / "err";
  std::vector<const char*> words = {AIRLIGHT_PROGRAM};
  for (const std::string& argument : arguments) words.push_back(argument.c_str());
  words.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    const auto redirect = [](const std::string& path, int to) {
      dup2(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), to);
    };
    redirect(out, STDOUT_FILENO);
    redirect(err, STDERR_FILENO);
    beside.before();
    execv(words[0], const_cast<char* const*>(words.data()));
    _exit(127);
  }
  beside.during(child);
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status), bytes_of(out),
          bytes_of(err)};
}

}  // namespace airlight::test
