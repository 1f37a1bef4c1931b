#pragma once
#include <CLI/CLI.hpp>
#include <functional>

/// Exit status where something the user gave is not accepted or a file cannot be written.
inline constexpr int bad_input = 2;

/// Does a verb's work and gives the program's exit status.
using Action = std::function<int()>;

/// Something the program can do: `airlight NAME …`.
struct Verb {
  const char* name;
  const char* meaning;
  Action (*set_up)(CLI::App& verb);  ///< declares the options; what it returns reads them
};
