#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "error.h"
#include "flags.h"
#include "image/atomic_file.h"
#include "numbers.h"
#include "scene_flags.h"
#include "study/comparison.h"
#include "verbs.h"

namespace {

using airlight::Error;

struct Flags {
  SceneFlags scene;
  std::string estimators = "rm,mcds,mcwvds,rees,reds,rewv";
  std::optional<std::string> spp;  ///< 1 to 64 if neither this nor a time is given
  airlight::ComparisonSettings settings;
  std::filesystem::path folder;
  bool quiet = false;
};

constexpr const char* examples = R"(Examples:
  airlight compare scenes/sphere_in_fog.toml --estimators rm,mcds,mcwvds --spp 1,2,4,8 -o report
  airlight compare scenes/sunroom.toml --equal-time 0.5 --size 320x180 -o report

All samples of a pixel share the ray through its centre, unless --samples-per-ray says otherwise.
)";

/// The words of a list, each once.
std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  for (const std::string& word : CLI::detail::split(list, ','))
    if (!word.empty() && std::ranges::find(words, word) == words.end()) words.push_back(word);
  return words;
}

int compare(Flags& flags) {
  flags.settings.estimators = words_of(flags.estimators);
  if (flags.settings.estimators.empty())
    throw Error(
        "--estimators: names none; accepted: names with commas between, such as rm,mcwvds,rewv");
  if (flags.spp && flags.settings.equal_time > 0)
    throw Error(
        fmt::format("--spp {}: is not accepted beside --equal-time, which finds the counts itself",
                    *flags.spp));
  const std::string spp = flags.spp.value_or("1,2,4,8,16,32,64");
  flags.settings.spp = whole_numbers(spp, ',');
  if (flags.settings.spp.empty() || !std::ranges::all_of(flags.settings.spp, [](std::int64_t n) {
        return n >= 1 && n <= airlight::most_compared_spp;
      }))
    throw Error(
        fmt::format("--spp {}: is no list of counts; accepted: whole numbers from 1 to {} with "
                    "commas between",
                    spp, airlight::most_compared_spp));
  std::ranges::sort(flags.settings.spp);
  flags.settings.spp.erase(std::ranges::unique(flags.settings.spp).begin(),
                           flags.settings.spp.end());
  const airlight::Scene scene = flags.scene.load();
  airlight::Image reference = airlight::check_comparison(scene, flags.settings);
  if (!flags.quiet) SceneFlags::tell(scene);
  airlight::make_folder(flags.folder);
  const airlight::Comparison comparison =
      airlight::compare_estimators(scene, flags.settings, std::move(reference));
  airlight::write_comparison(comparison, flags.scene.file().filename().string(), flags.folder);
  if (const std::string warning = airlight::warning_of(comparison);
      !flags.quiet && !warning.empty())
    fmt::print(stderr, "warning: {}\n", warning);
  if (!flags.quiet)
    fmt::print("{}: {} rows\n", (flags.folder / "index.html").string(), comparison.rows.size());
  return 0;
}

}  // namespace

Action set_up_compare(CLI::App& verb) {
  const auto flags = std::make_shared<Flags>();
  verb.footer(examples);
  flags->scene.declare(verb, {"estimator", "spp", "first_sample"});
  flags->scene.preset("render.samples_per_ray", "0");
  verb.add_option("--estimators", flags->estimators, "estimators with commas between")
      ->type_name("")
      ->capture_default_str();
  verb.add_option("--spp", flags->spp,
                  "sample counts with commas between; 1,2,4,8,16,32,64 if neither they nor a time "
                  "are given")
      ->type_name("");
  verb.add_option("--seeds", flags->settings.seeds, "independent runs of each, for the spread")
      ->type_name("")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  verb.add_option("--equal-time", flags->settings.equal_time,
                  "compares at as many samples as each estimator takes in this time, in seconds")
      ->type_name("")
      ->check(CLI::Range(1e-3, 1e6));
  verb.add_option("--reference", flags->settings.reference_file, "a picture to compare with")
      ->type_name("");
  verb.add_option(
          "--reference-spp", flags->settings.reference_spp,
          "samples of a computed reference; without it the exact closed form where there is one")
      ->type_name("")
      ->check(CLI::Range(std::int64_t{1}, airlight::most_compared_spp));
  verb.add_option("-o,--output", flags->folder, "folder for index.html, results.csv and pictures")
      ->required()
      ->type_name("");
  verb.add_flag("--quiet", flags->quiet, "prints nothing but errors");
  return [flags] { return compare(*flags); };
}
