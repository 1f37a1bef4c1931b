#include "image/mix.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "error.h"
#include "image/input.h"
#include "numbers.h"
#include "outputs.h"
#include "verbs.h"

namespace {

using airlight::Error, airlight::Gain;

struct Flags {
  std::filesystem::path file;
  std::vector<std::string> gains;
  Outputs outputs;
  bool quiet = false;
};

constexpr const char* examples = R"(Examples:
  airlight render stage.toml -o stage.exr --exr float
  airlight mix stage.exr --gain sun=0.4 --gain lamp=1.2,1,0.8 -o evening.exr -o evening.png

Lights get their group in the scene file; what belongs to none, such as the background, is the
group "ungrouped".
)";

/// "sun=0.4" or "lamp=1.2,1,0.8".
Gain gain_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::vector<double> factors =
      equals == std::string::npos ? std::vector<double>() : numbers(text.substr(equals + 1), ',');
  const auto fits = [](double x) { return x >= 0 && x <= 1e18; };
  if (equals == 0 || (factors.size() != 1 && factors.size() != 3) ||
      !std::ranges::all_of(factors, fits))
    throw Error(
        fmt::format("--gain {}: is no gain; accepted: GROUP=FACTOR or GROUP=R,G,B, each at "
                    "least 0, such as sun=0.4",
                    text));
  Gain gain{text.substr(0, equals)};
  for (std::size_t i = 0; i < 3; ++i) gain.factor[i] = float(factors[factors.size() == 1 ? 0 : i]);
  return gain;
}

std::vector<Gain> gains_of(const std::vector<std::string>& texts) {
  std::vector<Gain> gains;
  for (const std::string& text : texts) {
    Gain gain = gain_of(text);
    if (std::ranges::find(gains, gain.group, &Gain::group) != gains.end())
      throw Error(
          fmt::format("--gain {}: its group has a gain already; accepted: one for each", text));
    gains.push_back(std::move(gain));
  }
  return gains;
}

/// Tells in the metadata what was done, after what was done before.
void add_to_history(decltype(airlight::Picture::metadata)& metadata, const std::string& told) {
  for (auto& [key, value] : metadata)
    if (auto* before = key == "mix" ? std::get_if<std::string>(&value) : nullptr) {
      *before += ", then " + told;
      return;
    }
  metadata.emplace_back("mix", told);
}

int mix(Flags& flags) {
  flags.outputs.check();
  const std::vector<Gain> gains = gains_of(flags.gains);
  const airlight::Picture rendered = airlight::read_picture(flags.file);
  airlight::Picture mixed;
  try {
    mixed = airlight::mix(rendered, gains);
  } catch (const Error& error) {
    throw Error(flags.file.string() + ": " + error.what());
  }
  const std::string told = fmt::format("{}", fmt::join(flags.gains, " "));
  add_to_history(mixed.metadata, told);
  flags.outputs.write(mixed);
  if (!flags.quiet)
    fmt::print("{}: {} x {}, {}\n", flags.outputs.names(), mixed.width, mixed.height, told);
  return 0;
}

}  // namespace

Action set_up_mix(CLI::App& verb) {
  const auto flags = std::make_shared<Flags>();
  verb.footer(examples);
  verb.add_option("PICTURE", flags->file, "an EXR of a scene whose lights have groups")
      ->required()
      ->type_name("");
  verb.add_option("--gain", flags->gains,
                  "GROUP=FACTOR or GROUP=R,G,B: what a group's light is multiplied by; may be "
                  "repeated")
      ->required()
      ->type_name("")
      ->allow_extra_args(false);
  flags->outputs.declare(verb);
  verb.add_flag("--quiet", flags->quiet, "prints nothing but errors")->group("Output");
  return [flags] { return mix(*flags); };
}
