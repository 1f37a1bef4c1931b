#include <fmt/format.h>

#include <set>

#include "error.h"
#include "image/atomic_file.h"
#include "outputs.h"
#include "render/checkpoint.h"
#include "verbs.h"

namespace {

using airlight::Checkpoint, airlight::Error;

struct Flags {
  std::vector<std::filesystem::path> files;
  Outputs outputs;
  bool alpha = false;
  bool quiet = false;
};

constexpr const char* examples = R"(Examples:
  airlight render fog.toml --spp 512 --first-sample 0 -o a.png --checkpoint a.ckpt      # here
  airlight render fog.toml --spp 512 --first-sample 512 -o b.png --checkpoint b.ckpt    # there
  airlight merge a.ckpt b.ckpt -o fog.exr -o fog.ckpt
  airlight merge running.ckpt -o look.png

Ranges of samples of one seed give, to rounding, what one render of all of them gives. Other seeds
count as many samples as they have.
)";

Checkpoint sum_of(const std::vector<std::filesystem::path>& files) {
  Checkpoint sum = airlight::read_checkpoint(files.at(0));
  for (std::size_t i = 1; i < files.size(); ++i) {
    Checkpoint next = airlight::read_checkpoint(files[i]);
    try {
      airlight::merge(sum, std::move(next));
    } catch (const Error& error) {
      throw Error(fmt::format("{}: cannot be added to {}: {}", files[i].string(), files[0].string(),
                              error.what()));
    }
  }
  return sum;
}

/// What is in the sum, where it is more than one range of one seed.
std::string remark(const airlight::Film& film) {
  std::set<std::uint32_t> seeds;
  for (const airlight::SampleRun& run : film.runs) seeds.insert(run.seed);
  if (seeds.size() > 1)
    return fmt::format("; {} seeds, weighted by their samples: not as even as one seed",
                       seeds.size());
  return film.runs.size() > 1 ? "; samples are missing in between: not as even as without gaps"
                              : "";
}

int merge(Flags& flags) {
  const std::string names = flags.outputs.names();
  const auto kept = flags.outputs.take(".ckpt");
  flags.outputs.check(kept);
  for (const auto& file : kept) airlight::check_writable(file);
  const Checkpoint sum = sum_of(flags.files);
  if (flags.alpha && airlight::value_of(sum.origin.traits, airlight::what_is_behind) != "left out")
    throw Error(flags.files.at(0).string() +
                ": holds a background, which --alpha cannot take out; accepted: renders that were "
                "made with --alpha");
  const airlight::Film& film = sum.film;
  airlight::Picture picture = film.picture();
  if (flags.alpha) add_alpha(picture);
  tell_origin(picture, airlight::value_of(sum.origin.traits, "render.estimator"),
              airlight::value_of(sum.origin.traits, "render.samples_per_ray"), sum.origin.seconds,
              sum.origin.instruction_set, sum.origin.version);
  flags.outputs.write(picture);
  for (const auto& file : kept) airlight::write_checkpoint(file, film, sum.origin);
  if (!flags.quiet)
    fmt::print("{}: {} x {}, {} spp of {} file{}, {:.2f} s{}\n", names, film.crop.width,
               film.crop.height, samples_of(film), flags.files.size(),
               flags.files.size() == 1 ? "" : "s", sum.origin.seconds, remark(film));
  return 0;
}

}  // namespace

Action set_up_merge(CLI::App& verb) {
  const auto flags = std::make_shared<Flags>();
  verb.footer(examples);
  verb.add_option("CHECKPOINT", flags->files, "files that render --checkpoint has written")
      ->required()
      ->type_name("");
  flags->outputs.declare(verb, "the picture, .png, .exr or .pfm, or the sums, .ckpt");
  verb.add_flag("--alpha", flags->alpha, "writes alpha, for renders that were made with --alpha")
      ->group("Output");
  verb.add_flag("--quiet", flags->quiet, "prints nothing but errors")->group("Output");
  return [flags] { return merge(*flags); };
}
