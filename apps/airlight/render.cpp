#include "render/render.h"

#include <fmt/format.h>

#include "error.h"
#include "flags.h"
#include "interrupt.h"
#include "numbers.h"
#include "outputs.h"
#include "progress_line.h"
#include "render/summary.h"
#include "render/version.h"
#include "scene_flags.h"
#include "verbs.h"

namespace {

using airlight::Error, airlight::PixelRect, airlight::Rendered, airlight::Scene;

/// When a render shows what it has and when it ends.
struct Schedule {
  double preview = 0;
  double time_limit = 0;

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    field("preview", &Schedule::preview, airlight::unit::second, airlight::closed(0.1, 1e6),
          "writes the output again every so often while rendering; without a number every 2 s");
    field("time_limit", &Schedule::time_limit, airlight::unit::second, airlight::above(0),
          "stops after this time and writes what is done");
  }
};

struct Flags {
  SceneFlags scene;
  Outputs outputs;
  std::vector<airlight::Override> schedule;
  std::string crop;
  bool alpha = false;
  bool quiet = false;
};

constexpr const char* examples = R"(Examples:
  airlight render scenes/sunroom.toml -o sunroom.png
  airlight render model.glb -o out.exr -o out.png --size 1280x720 --spp 64
  airlight render fog.toml -o fog.png -D lights.0.irradiance=3 --exposure -1 --tonemap filmic
  airlight render fog.toml -o fog.png --background photo.jpg --size 1600x900
  airlight render fog.toml -o layer.exr -o layer.png --alpha
  airlight render fog.toml -o fog.exr --spp 1024 --preview 2 --time-limit 60

Ctrl-C ends a render and writes what is done (exit status 130); a second Ctrl-C ends it at once.
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

/// The film with how it came about.
airlight::Picture picture_of(const airlight::Film& film, const airlight::RenderSettings& settings,
                             bool alpha, const char* instruction_set, std::int64_t samples,
                             double seconds) {
  airlight::Picture picture = film.picture();
  if (alpha) add_alpha(picture);
  picture.metadata = {{"spp", samples},
                      {"samples_per_ray", settings.samples_per_ray},
                      {"first_sample", settings.first_sample.value_or(0)},
                      {"seed", settings.seed},
                      {"estimator", settings.estimator},
                      {"seconds", seconds},
                      {"isa", std::string(instruction_set)},
                      {"version", std::string(airlight::version())}};
  return picture;
}

int render(Flags& flags) {
  flags.outputs.check();
  const auto schedule = read_flags<Schedule>(flags.schedule);
  const std::optional<PixelRect> crop = crop_of(flags.crop);
  Scene scene = flags.scene.load();
  if (flags.alpha) scene.background = {}, scene.background_image = {};
  airlight::Renderer renderer(scene);
  renderer.check(scene.render);
  if (!flags.quiet) SceneFlags::tell(scene);

  const Interrupt interrupt;
  ProgressLine line(!flags.quiet);
  std::stop_source stop;
  airlight::RenderControl control;
  control.crop = crop;
  control.time_limit = schedule.time_limit;
  control.stop = stop.get_token();
  control.on_progress = [&](const airlight::Progress& progress) {
    if (Interrupt::received()) stop.request_stop();
    line.show(progress);
  };
  const char* const instruction_set = renderer.instruction_set(scene.render);
  if (schedule.preview > 0) {
    control.short_passes = true;
    control.on_pass = [&, next = 0.](const airlight::Film& film,
                                     const airlight::Progress& progress) mutable {
      if (progress.seconds < next || progress.samples_done == progress.samples) return;
      try {
        flags.outputs.write(picture_of(film, scene.render, flags.alpha, instruction_set,
                                       progress.samples_done, progress.seconds));
      } catch (const Error& error) {  // the render goes on: its last picture may succeed
        line.clear();
        fmt::print(stderr, "{}\n", error.what());
      }
      next = progress.seconds + schedule.preview;
    };
  }

  const Rendered done = renderer.render(scene.render, control);
  line.clear();
  flags.outputs.write(picture_of(done.film, scene.render, flags.alpha, done.instruction_set,
                                 done.samples, done.seconds));
  if (done.rejected > 0)
    fmt::print(stderr, "warning: {} sums of pixels were not finite and were left out\n",
               done.rejected);
  if (!flags.quiet) {
    for (const std::string& warning : airlight::warnings_after(scene, done.film))
      fmt::print(stderr, "warning: {}\n", warning);
    const std::string of = done.complete ? "" : fmt::format(" of {}", scene.render.spp);
    fmt::print("{}: {} x {}, {}{} spp, {:.2f} s ({})\n", flags.outputs.names(),
               done.film.crop.width, done.film.crop.height, done.samples, of, done.seconds,
               done.instruction_set);
  }
  return done.complete || !Interrupt::received() ? 0 : 128 + Interrupt::received();
}

}  // namespace

Action set_up_render(CLI::App& verb) {
  const auto flags = std::make_shared<Flags>();
  verb.footer(examples);
  flags->scene.declare(verb);
  flags->outputs.declare(verb);
  verb.add_option("--crop", flags->crop, "renders X,Y,WIDTH,HEIGHT of the picture only, in pixels")
      ->type_name("")
      ->group("Scene");
  add_flags<Schedule>(verb, "", "Output", flags->schedule);
  verb.add_flag("--alpha", flags->alpha,
                "leaves the background out and writes alpha: EXR with colours multiplied by it, "
                "PNG for an image editor")
      ->group("Output");
  verb.add_flag("--quiet", flags->quiet, "prints nothing but errors")->group("Output");
  return [flags] { return render(*flags); };
}
