#pragma once
#include <CLI/CLI.hpp>
#include <functional>

/// Does a verb's work and gives the program's exit status.
using Action = std::function<int()>;

/// Something the program can do: `airlight NAME …`.
struct Verb {
  const char* name;
  const char* meaning;
  Action (*set_up)(CLI::App& verb);  ///< declares the options; what it returns reads them
};
