#include <fmt/format.h>

#include <chrono>

#include "error.h"
#include "report/text.h"
#include "study/reproductions.h"
#include "verbs.h"

namespace {

using airlight::Reproduction, airlight::Row;

constexpr int out_of_range = 1;

struct Flags {
  std::string name;
  std::filesystem::path folder, scene;
};

constexpr const char* examples = R"(Examples:
  airlight reproduce
  airlight reproduce 000/fig6-single -o fig6
  airlight reproduce 000/table2 --scene room.glb -o table2
  airlight reproduce 000 -o report

Without a name it lists what there is. A part of a name, such as 000, means all that begin with it; each then has a folder
of its own. Exit status 1 if a value leaves its range.
)";

int list() {
  for (const Reproduction& r : airlight::reproductions())
    fmt::print("{:<18} {}\n", r.name, r.shows);
  return 0;
}

/// Runs one and tells how it went, a line for each value that leaves its range.
bool holds(const Reproduction& reproduction, const std::filesystem::path& folder,
           const std::filesystem::path& scene) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Row> rows = reproduce(reproduction, folder, scene);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  std::size_t held = 0, reported = 0;
  for (const Row& row : rows) {
    held += row.is_held() && row.holds();
    reported += !row.is_held() && row.holds();
    if (!row.holds())
      fmt::print(stderr, "{}: {}: {} is not between {} and {}\n", reproduction.name, row.label,
                 airlight::number(row.measured), airlight::number(row.low),
                 airlight::number(row.high));
  }
  fmt::print("{}: {} of {} values hold, {:.1f} s, {}\n", reproduction.name, held,
             rows.size() - reported, taken.count(), (folder / "index.html").string());
  std::fflush(stdout);
  return held + reported == rows.size();
}

int reproduce_all(const Flags& flags) {
  const auto chosen = airlight::reproductions_named(flags.name);
  if (flags.folder.empty())
    throw airlight::Error(
        "reproduce: -o is missing; accepted: -o DIR, the folder that the page goes to");
  if (!flags.scene.empty()) airlight::check_take_scene(chosen);
  bool all_hold = true;
  for (const Reproduction* r : chosen)
    all_hold &=
        holds(*r, r->name == flags.name ? flags.folder : flags.folder / r->name, flags.scene);
  return all_hold ? 0 : out_of_range;
}

}  // namespace

Action set_up_reproduce(CLI::App& verb) {
  const auto flags = std::make_shared<Flags>();
  verb.footer(examples);
  verb.add_option("name", flags->name, "what to reproduce, such as 000/fig6-single")->type_name("");
  verb.add_option("-o,--output", flags->folder, "the folder that the page goes to")->type_name("");
  verb.add_option("--scene", flags->scene,
                  "a scene or model to show instead of its own, where a reproduction can")
      ->type_name("FILE");
  return [flags] { return flags->name.empty() ? list() : reproduce_all(*flags); };
}
