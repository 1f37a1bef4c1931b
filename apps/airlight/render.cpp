#include "render/render.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <mutex>
#include <utility>

#include "error.h"
#include "flags.h"
#include "frame_range.h"
#include "image/numbered.h"
#include "interrupt.h"
#include "numbers.h"
#include "outputs.h"
#include "progress_line.h"
#include "render/checkpoint_keeper.h"
#include "render/prepare.h"
#include "render/summary.h"
#include "render/version.h"
#include "scene_flags.h"
#include "verbs.h"

namespace {

using airlight::Error, airlight::PixelRect, airlight::Rendered, airlight::Scene;

/// When a render shows and keeps what it has, and when it ends.
struct Schedule {
  double preview = 0;
  double time_limit = 0;
  double checkpoint_every = 60;

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    field("preview", &Schedule::preview, airlight::unit::second, airlight::closed(0.1, 1e6),
          "writes the output again every so often while rendering; without a number every 2 s");
    field("time_limit", &Schedule::time_limit, airlight::unit::second, airlight::above(0),
          "stops after this time and writes what is done; of a run of frames, the whole ones");
    field("checkpoint_every", &Schedule::checkpoint_every, airlight::unit::second,
          airlight::closed(0.01, 1e6),
          "how often the checkpoint is written; without it every 60 s");
  }
};

struct Flags {
  SceneFlags scene;
  Outputs outputs;
  std::vector<airlight::Override> schedule;
  std::string crop;
  bool alpha = false;
  std::string frames;
  bool skip_existing = false;
  std::filesystem::path checkpoint;
  bool resume = false;
  bool quiet = false;
};

constexpr const char* examples = R"(Examples:
  airlight render scenes/sunroom.toml -o sunroom.png
  airlight render model.glb -o out.exr -o out.png --size 1280x720 --spp 64
  airlight render fog.toml -o fog.png -D lights.0.irradiance=3 --exposure -1 --tonemap filmic
  airlight render fog.toml -o fog.png --background photo.jpg --size 1600x900
  airlight render fog.toml -o layer.exr -o layer.png --alpha
  airlight render fog.toml -o fog.exr --spp 1024 --preview 2 --time-limit 60
  airlight render scenes/destruction.toml --frames 0..47 -o wall.####.png --skip-existing
  airlight render fog.toml -o fog.exr --spp 65536 --checkpoint fog.ckpt --resume

Ctrl-C, SIGTERM or a terminal that closes ends a render and writes what is done (exit status 130, 143 or 129); a second
one ends it at once. Of a run of frames only whole ones are written, also where --time-limit ends it; with
--skip-existing the same command goes on where a run ended. With --checkpoint and --resume the same command goes on in
the middle of a picture, whatever ended it, or with more --spp after its end. A picture of few, --spp up to
--samples-per-ray, takes them through the pixels' centres: to go on beyond, give --samples-per-ray all, or begin it with
--first-sample 0, which spreads its rays as those of a longer one.
)";

std::optional<PixelRect> crop_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto n = whole_numbers(text, ',');
  const auto fits = [](std::int64_t x) { return x >= 0 && x <= 65535; };
  if (n.size() != 4 || !std::ranges::all_of(n, fits))
    throw Error("--crop " + text +
                ": is no crop; accepted: X,Y,WIDTH,HEIGHT in pixels, such as 0,0,64,32");
  return PixelRect{int(n[0]), int(n[1]), int(n[2]), int(n[3])};
}

/// Throws Error for flags that mean nothing without a checkpoint.
void check_no_checkpoint(const Flags& flags) {
  for (const airlight::Override& flag : flags.schedule)
    if (flag.path == "checkpoint_every")
      throw Error(flag.said + ": of which file? accepted: together with --checkpoint FILE");
  if (flags.resume) throw Error("--resume: which file? accepted: together with --checkpoint FILE");
}

/// What holds for every picture of a run.
struct Manner {
  Schedule schedule;
  std::optional<PixelRect> crop;
  std::filesystem::path checkpoint;
  bool resume;
  bool alpha;
  bool quiet;

  explicit Manner(const Flags& flags)
      : schedule(read_flags<Schedule>(flags.schedule)),
        crop(crop_of(flags.crop)),
        checkpoint(flags.checkpoint),
        resume(flags.resume),
        alpha(flags.alpha),
        quiet(flags.quiet) {
    if (checkpoint.empty()) check_no_checkpoint(flags);
  }

  /// What is written beside the pictures.
  std::vector<std::filesystem::path> files() const {
    if (checkpoint.empty()) return {};
    return {checkpoint};
  }

  airlight::CheckpointPlan checkpoint_plan() const {
    return {
        .file = checkpoint, .every = schedule.checkpoint_every, .resume = resume, .on_failure = {}};
  }
};

/// The film with how it came about.
airlight::Picture picture_of(const airlight::Film& film, const airlight::RenderSettings& settings,
                             bool alpha, const char* instruction_set, double seconds) {
  airlight::Picture picture = film.picture();
  if (alpha) add_alpha(picture);
  tell_origin(picture, settings.estimator, fmt::format("{}", settings.samples_per_ray), seconds,
              instruction_set, airlight::version());
  picture.metadata.emplace_back("frame", settings.frame);
  return picture;
}

/// Throws Error if the sums of so many pixels are more than the machine could ever hold: the system
/// grants memory that it does not have.
void check_memory(const Scene& scene, const std::optional<PixelRect>& crop) {
  const std::int64_t width = crop ? crop->width : scene.resolution.width;
  const std::int64_t height = crop ? crop->height : scene.resolution.height;
  const double bytes =
      double(width * height) *
      double(film_layout(scene, airlight::estimator_for(scene.render)).bytes_a_pixel());
  const double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  constexpr double gib = 1 << 30;
  if (bytes > memory)
    throw Error(fmt::format(
        "{} x {} pixels need {:.1f} GiB, and this machine has {:.1f}; accepted: a smaller --size, "
        "or a --crop of it",
        width, height, bytes / gib, memory / gib));
}

/// Which picture of a run of frames one is.
struct Turn {
  std::string name;  ///< for the progress line; empty for a picture by itself
  bool is_first = true;
};

/// How the render of a picture ended.
struct Ending {
  int status = 0;
  bool is_written = true;
};

/// Renders a scene into files; a frame of a run only if it is whole.
Ending render_picture(Scene scene, const Outputs& outputs, const Manner& manner,
                      const Turn& turn = {}) {
  if (manner.alpha) scene.background_is_seen = false;
  check_memory(scene, manner.crop);
  airlight::Renderer renderer(scene);
  renderer.check(scene.render);
  if (!manner.quiet && turn.is_first) SceneFlags::tell(scene);

  const Interrupt interrupt;
  ProgressLine line(!manner.quiet, turn.name);
  std::mutex telling;  // of what more than one thread may come to tell
  const auto tell = [&](const Error& error) {
    const std::scoped_lock lock(telling);
    line.clear();
    fmt::print(stderr, "{}\n", error.what());
  };
  std::stop_source stop;
  airlight::RenderControl control;
  control.crop = manner.crop;
  control.time_limit = manner.schedule.time_limit;
  control.stop = stop.get_token();
  control.on_progress = [&](const airlight::Progress& progress) {
    if (Interrupt::received()) stop.request_stop();
    const std::scoped_lock lock(telling);
    line.show(progress);
  };
  if (!manner.checkpoint.empty()) {
    control.checkpoint = manner.checkpoint_plan();
    control.checkpoint->on_failure = tell;
  }
  const char* const instruction_set = renderer.instruction_set(scene.render);
  if (manner.schedule.preview > 0) {
    control.short_passes = true;
    control.on_pass = [&, next = 0., told = false](const airlight::Film& film,
                                                   const airlight::Progress& progress) mutable {
      if (progress.seconds < next || progress.samples_done == progress.samples) return;
      try {
        outputs.write(
            picture_of(film, scene.render, manner.alpha, instruction_set, progress.seconds));
        told = false;
      } catch (const Error& error) {  // the render goes on: its last picture may succeed
        if (!std::exchange(told, true)) tell(error);
      }
      next = progress.seconds + manner.schedule.preview;
    };
  }

  const Rendered done = renderer.render(scene.render, control);
  line.clear();
  const int status = !done.complete && Interrupt::received() ? 128 + Interrupt::received() : 0;
  if (!done.complete && !turn.name.empty()) return {done.kept ? status : bad_input, false};
  outputs.write(
      picture_of(done.film, scene.render, manner.alpha, done.instruction_set, done.seconds));
  if (done.rejected > 0)
    fmt::print(stderr, "warning: {} sums of pixels were not finite and were left out\n",
               done.rejected);
  if (!manner.quiet) {
    if (turn.name.empty())  // a frame of a film may well be dark
      for (const std::string& warning : airlight::warnings_after(scene, done.film))
        fmt::print(stderr, "warning: {}\n", warning);
    const std::string of = done.complete ? "" : fmt::format(" of {}", scene.render.spp);
    fmt::print("{}: {} x {}, {}{} spp, {:.2f} s ({})\n", outputs.names(), done.film.crop.width,
               done.film.crop.height, samples_of(done.film), of, done.seconds,
               done.instruction_set);
  }
  return {done.kept ? status : bad_input};
}

/// Renders the frames that are wanted, one after the other.
int render_frames(const Flags& flags) {
  const auto start = std::chrono::steady_clock::now();
  const FrameRange range = frame_range(flags.frames);
  Manner manner(flags);
  const double time_limit = manner.schedule.time_limit;
  if (!flags.checkpoint.empty() && !airlight::is_pattern(flags.checkpoint))
    throw Error(
        flags.checkpoint.string() +
        ": has no place for the number of a frame, which --frames wants; accepted is a name "
        "such as out.####.ckpt");
  if (manner.schedule.preview > 0)
    throw Error("--preview does not go with --frames: a frame that is not whole would look done");
  if (const std::string frame = flags.scene.said("render.frame"); !frame.empty())
    throw Error(frame + ": the frames are those of --frames " + flags.frames +
                "; accepted: one of the two");
  const airlight::SceneFile file = flags.scene.open();
  std::vector<std::int64_t> wanted;
  for (std::int64_t frame = range.first; frame <= range.last; ++frame) {
    Outputs outputs = flags.outputs.of_frame(frame);
    manner.checkpoint = airlight::numbered(flags.checkpoint, frame);
    outputs.check(manner.files());
    if (flags.skip_existing && outputs.exist()) continue;
    file.check(frame);
    wanted.push_back(frame);
    if (!manner.checkpoint.empty()) check_place(manner.checkpoint_plan());
  }
  if (const auto skipped = range.count() - std::ssize(wanted); skipped > 0 && !flags.quiet)
    fmt::print("{} of {} frames are there already\n", skipped, range.count());

  for (std::size_t i = 0; i < wanted.size(); ++i) {
    Scene scene = flags.scene.load(file, wanted[i]);
    Outputs outputs = flags.outputs.of_frame(wanted[i]);
    manner.checkpoint = airlight::numbered(flags.checkpoint, wanted[i]);
    outputs.check(manner.files());
    const std::string name = fmt::format("frame {}, {} of {}", wanted[i], i + 1, wanted.size());
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    // Not 0, which is no limit.
    if (time_limit > 0) manner.schedule.time_limit = std::max(time_limit - spent.count(), 1e-9);
    const Ending ending = render_picture(std::move(scene), outputs, manner, {name, i == 0});
    if (ending.status != 0) return ending.status;
    if (!ending.is_written) {
      if (!flags.quiet)
        fmt::print("frame {} is cut short by the time limit and not written; {} of {} are there\n",
                   wanted[i], range.count() - std::ssize(wanted) + std::ptrdiff_t(i),
                   range.count());
      return 0;
    }
    std::fflush(stdout);
  }
  return 0;
}

int render(Flags& flags) {
  if (!flags.frames.empty()) return render_frames(flags);
  const Manner manner(flags);
  flags.outputs.check(manner.files());
  if (airlight::is_pattern(flags.checkpoint))
    throw Error(flags.checkpoint.string() +
                ": # stands for the number of a frame, which --frames gives");
  if (flags.skip_existing && flags.outputs.exist()) {
    if (!flags.quiet) fmt::print("{}: there already\n", flags.outputs.names());
    return 0;
  }
  return render_picture(flags.scene.load(), flags.outputs, manner).status;
}

}  // namespace

Action set_up_render(CLI::App& verb) {
  const auto flags = std::make_shared<Flags>();
  verb.footer(examples);
  flags->scene.declare(verb);
  flags->outputs.declare(verb);
  verb.add_option("--frames", flags->frames,
                  "renders FIRST..LAST of an animation, or one; the outputs' names have #### where "
                  "the number goes")
      ->type_name("")
      ->take_last()
      ->group("Output");
  verb.add_flag("--skip-existing", flags->skip_existing,
                "leaves out pictures that are there already, so that a run can be taken up again")
      ->group("Output");
  verb.add_option("--crop", flags->crop, "renders X,Y,WIDTH,HEIGHT of the picture only, in pixels")
      ->type_name("")
      ->group("Scene");
  add_flags<Schedule>(verb, "", "Output", flags->schedule);
  verb.add_flag("--alpha", flags->alpha,
                "leaves the background out and writes alpha: EXR with colours multiplied by it, "
                "PNG for an image editor")
      ->group("Output");
  verb.add_option(
          "--checkpoint", flags->checkpoint,
          "keeps the sums of all samples in a file while rendering, and at the end: to go on "
          "later, or for airlight merge")
      ->type_name("FILE")
      ->group("Output");
  verb.add_flag("--resume", flags->resume,
                "goes on with what the checkpoint holds, if it is there; more --spp extend a "
                "finished one")
      ->group("Output");
  verb.add_flag("--quiet", flags->quiet, "prints nothing but errors")->group("Output");
  return [flags] { return render(*flags); };
}
