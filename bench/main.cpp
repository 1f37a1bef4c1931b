// airlight_bench: measures what the project promises about speed and says whether it holds.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <iterator>
#include <regex>

#include "error.h"
#include "image/atomic_file.h"
#include "table.h"

namespace {

using namespace airlight::bench;

struct Options {
  std::string filter;
  std::string json;
  bool list = false;
};

struct Result {
  std::vector<Row> rows;
  bool all_hold = true;
};

std::vector<Bench> chosen(const std::string& filter) {
  std::vector<Bench> all = benches();
  if (filter.empty()) return all;
  const std::regex pattern(filter);
  std::erase_if(all, [&](const Bench& bench) { return !std::regex_search(bench.name, pattern); });
  if (all.empty())
    throw airlight::Error(
        fmt::format("--filter: no row's name matches {}; --list names them", filter));
  return all;
}

/// A measurement that fails counts as one that falls short, and does not keep the others from being
/// made.
Result measure(const std::vector<Bench>& all) {
  Result result;
  for (const Bench& bench : all) {
    std::cerr << "measuring " << bench.name << std::endl;
    try {
      std::ranges::copy(bench.measure(), std::back_inserter(result.rows));
    } catch (const std::exception& error) {
      std::cerr << bench.name << ": " << error.what() << std::endl;
      result.rows.push_back({bench.name, NAN, "", {}, ""});  // keeps no bound
    }
  }
  for (const Row& row : result.rows) result.all_hold &= row.holds();
  return result;
}

int run(const Options& options) {
  const std::vector<Bench> all = chosen(options.filter);
  if (options.list) {
    for (const Bench& bench : all) fmt::print("{}: {}\n", bench.name, bench.meaning);
    return 0;
  }
  if (!options.json.empty()) airlight::check_writable(options.json);
  const Result result = measure(all);
  std::cout << table(result.rows);
  if (!options.json.empty()) airlight::write_text(options.json, to_json(result.rows));
  return result.all_hold ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Measures what Airlight promises about speed; exits with 1 when a row falls short, 2 on bad "
      "input");
  app.add_option("--filter", options.filter,
                 "only the rows whose name matches this regular expression");
  app.add_option("--json", options.json,
                 "write the rows to this file, too: [{name, value, unit, must, holds}]");
  app.add_flag("--list", options.list, "name the rows, measure nothing");
  CLI11_PARSE(app, argc, argv);
  try {
    return run(options);
  } catch (const std::regex_error&) {
    std::cerr << "--filter: " << options.filter << " is not a regular expression\n";
  } catch (const airlight::Error& error) {
    std::cerr << error.what() << '\n';
  }
  return 2;
}
