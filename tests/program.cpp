// The program as its users meet it: what it prints, writes and gives back.

#include <gmock/gmock.h>
#include <pty.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "image/input.h"
#include "render/version.h"
#include "scene/render_settings.h"
#include "support/refused.h"
#include "support/scene_desk.h"

namespace airlight::test {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;
using namespace std::chrono_literals;

/// A ball in fog, coloured so that channels cannot be mixed up.
constexpr const char* scene_text = R"(
[camera]
position = [0, 0.2, 3.1]
target = [0, 0, 0]
[image]
width = 24
height = 16
[[media]]
albedo = 1
sigma_t = [0.3, 1, 3]
shape = {type = "box", min = [-1, -1, -1], max = [1, 1, 1]}
[[lights]]
type = "directional"
irradiance = 20
direction = [-1, -1, 0.2]
[[objects]]
type = "sphere"
radius = 0.7
)";

struct Desk : SceneDesk {
  Desk() : SceneDesk("scene.toml", scene_text) {}
};

const std::vector<std::string> endless = {"--spp", "268435456", "--size", "64x64"};

std::vector<std::string> with(std::vector<std::string> flags,
                              const std::vector<std::string>& more) {
  flags.insert(flags.end(), more.begin(), more.end());
  return flags;
}

// ---- help

TEST(Program, tells_its_version) {
  const Outcome outcome = run({"--version"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, std::string("airlight ") + version() + "\n");
}

TEST(Program, helps_with_every_verb_and_shows_examples) {
  const Outcome all = run({"--help"});
  EXPECT_EQ(all.status, 0);
  EXPECT_EQ(all.err, "");
  for (const std::string verb : {"render", "probe", "info", "compare", "list", "reproduce"}) {
    EXPECT_THAT(all.out, HasSubstr("  " + verb + " "));
    const Outcome one = run({verb, "--help"});
    EXPECT_EQ(one.status, 0);
    EXPECT_THAT(one.out, HasSubstr("Examples:\n  airlight " + verb));
  }
}

TEST(Program, has_a_flag_for_every_setting_of_a_render) {
  const Outcome help = run({"render", "--help"});
  RenderSettings::describe(
      [&](std::string key, auto, const char*, const Range&, const char* meaning) {
        std::ranges::replace(key, '_', '-');
        EXPECT_THAT(help.out, HasSubstr("--" + key + " "));
        EXPECT_THAT(help.out, HasSubstr(meaning));
      });
  EXPECT_THAT(help.out,
              HasSubstr("without filter: a whole number in [0, 268435456], or all for 0"));
  EXPECT_THAT(help.out, Not(HasSubstr("quotes"))) << "which a shell would take away";
}

TEST(Program, lists_one_chapter_when_asked) {
  const Outcome lights = run({"list", "lights"});
  EXPECT_EQ(lights.status, 0) << lights.err;
  EXPECT_THAT(lights.out, StartsWith("Lights\n"));
  EXPECT_THAT(run({"list"}).out, HasSubstr(lights.out));
  EXPECT_THAT(lights.out, Not(HasSubstr("\nShapes\n")));
  EXPECT_THAT(run({"list", "keys-of-lights"}).out, StartsWith("Keys of lights\n"));
  expect_refused(run({"list", "foo"}),
                 "list: foo is not known here; accepted: cross-sections, estimators, forms, ");
}

// ---- what cannot be done

TEST(Program, refuses_a_command_line_in_one_line) {
  expect_refused(run({}), "a verb is missing; accepted: render, ");
  expect_refused(run({"rendr"}), "rendr is not known here; accepted: render, ");
  expect_refused(run({"render"}), "SCENE");
  expect_refused(run({"render", "a.toml"}), "--output");
  expect_refused(run({"render", "a.toml", "-o", "a.png", "--sppp", "3"}),
                 "--sppp is not known here; accepted: ");
  expect_refused(run({"render", "a.toml", "b.toml", "-o", "a.png"}), "b.toml");
  expect_refused(run({"render", "a.toml", "-o", "a.png", "--spp"}), "--spp needs a value");
  expect_refused(run({"render", "none.toml", "-o", "/tmp/never.png"}), "none.toml: cannot be read");
}

TEST(Program, refuses_wrong_values_of_flags_and_touches_no_file) {
  struct Case {
    std::vector<std::string> flags;
    const char* said;
  };
  const Case cases[] = {
      {{"--spp", "0"}, "--spp 0: render.spp = 0 is out of range: a whole number in [1, "},
      {{"--spp", "many"}, "--spp many: render.spp = \"many\" is not a whole number"},
      {{"--samples-per-ray", "3"},
       "--samples-per-ray 3: render.samples_per_ray = 3 is not accepted: a power of two"},
      {{"--samples-per-ray", "-1"}, "--samples-per-ray -1: "},
      {{"--seed", "4294967296"}, "--seed 4294967296: "},
      {{"--max-depth", "0"},
       "--max-depth 0: render.max_depth = 0 is out of range: a whole number in [1, 65536]"},
      {{"--mix-weight", "1"}, "--mix-weight 1: "},
      {{"--threads", "-1"}, "--threads -1: "},
      {{"--size", "0x0"},
       "--size 0x0: image.width = 0 is out of range: a whole number in [1, 65535]"},
      {{"--size", "70000x1"}, "--size 70000x1: image.width = 70000 is out of range"},
      {{"--size", "1x70000"}, "--size 1x70000: image.height = 70000 is out of range"},
      {{"--size", "64"}, "--size 64: is no size; accepted: WIDTHxHEIGHT"},
      {{"--size", "99999999999999999999x1"}, "is no size"},
      {{"--crop", "1,2,3"}, "--crop 1,2,3: is no crop; accepted: X,Y,WIDTH,HEIGHT"},
      {{"--crop", "0,0,0,4"}, "accepted: X,Y,W,H inside 24 x 16"},
      {{"--crop", "20,0,5,4"}, "accepted: X,Y,W,H inside 24 x 16"},
      {{"--crop", "-1,0,5,4"}, "is no crop"},
      {{"--isa", "mmx"}, "accepted: avx2, avx512, baseline, best, double, scalar"},
      {{"--estimator", "magic"},
       "--estimator magic: render.estimator = \"magic\" is not known here; accepted: rm, "},
      {{"--edges", "per_step"}, "goes with rm"},
      {{"--filter", "sharp"}, "accepted: box, gaussian, tent"},
      {{"--exposure", "bright"}, "--exposure bright: exposure = \"bright\" is not a number"},
      {{"--exposure", "nan"}, "--exposure nan: "},
      {{"--tonemap", "pretty"}, "accepted: filmic, none"},
      {{"--exr", "double"}, "accepted: float, half"},
      {{"--preview", "0"}, "--preview 0: "},
      {{"--time-limit", "0"}, "--time-limit 0: "},
      {{"--time-limit", "-5"}, "--time-limit -5: "},
      {{"-D", "render.spp"}, "a change is path=value"},
      {{"-D", "render.spp=0"}, "-D render.spp=0: render.spp = 0 is out of range"},
      {{"-D", "fog.density=1"}, "fog is not known here; accepted: "},
      {{"-D", "lights.1.irradiance=1"}, "lights.1 is not there"},
      {{"-D", "media.0.shape.type=unbounded"}, ""},
  };
  for (const Case& c : cases) {
    const Desk desk;
    write_bytes(desk / "out.png", "old");
    SCOPED_TRACE(c.said);
    expect_refused(desk.render("out.png", c.flags), c.said);
    EXPECT_EQ(bytes_of(desk / "out.png"), "old");
    EXPECT_THAT(desk.folder.names(), ElementsAre("out.png", "scene.toml"));
  }
}

TEST(Program, refuses_outputs_before_it_renders) {
  const Desk desk;
  std::filesystem::create_directory(desk / "folder.png");
  // Endless renders: these tests end only because they never begin.
  expect_refused(desk.render("out.jpg", endless), "accepted: .exr, .pfm, .png");
  expect_refused(desk.render("out", endless), "accepted: .exr, .pfm, .png");
  expect_refused(desk.render("missing/out.png", endless), "there is no folder ");
  expect_refused(desk.render("folder.png", endless), "folder.png: cannot be written: it is a");
  expect_refused(desk.render(".", endless), "is a folder; accepted: a file in it, such as ");
  expect_refused(desk.render("out.png", {"--size", "65535x65535"}), "65535 x 65535 pixels need ");
  expect_refused(desk.render("good.png", with(endless, {"-o", desk / "bad.gif"})), "bad.gif");
  const std::string twice = "q.png: would be written twice; accepted: another file for each output";
  expect_refused(desk.render("q.png", with(endless, {"-o", desk / "q.png"})), twice);
  expect_refused(desk.render("./q.png", with(endless, {"-o", desk / "q.png"})), twice);
  expect_refused(desk.render("q.png", with(endless, {"--checkpoint", desk / "q.png"})), twice);
  expect_refused(
      desk.render("w.#.png", with(endless, {"--frames", "0..1", "--checkpoint", desk / "w.#.png"})),
      "w.0.png: would be written twice");
  EXPECT_THAT(desk.folder.names(), ElementsAre("folder.png", "scene.toml"));
}

TEST(Program, says_when_the_disk_is_full) {
  const Desk desk;
  std::filesystem::create_symlink("/dev/full", desk / "out.png");
  expect_refused(desk.render("out.png"), "No space left");
}

TEST(Program, says_when_what_it_prints_is_lost) {
  const Desk desk;
  const Outcome outcome = run(
      {"info", desk.scene}, {.before = [] { dup2(::open("/dev/full", O_WRONLY), STDOUT_FILENO); }});
  expect_refused(outcome, "No space left");
}

TEST(Program, keeps_the_old_file_when_the_new_one_may_not_grow) {
  for (const std::string name : {"out.png", "out.pfm", "out.exr"}) {
    const Desk desk;
    write_bytes(desk / name, "old");
    const Outcome outcome = desk.render(name, {"--size", "200x200"}, {.before = [] {
                                          const rlimit limit{512, 512};
                                          setrlimit(RLIMIT_FSIZE, &limit);
                                        }});
    expect_refused(outcome, name);
    EXPECT_EQ(bytes_of(desk / name), "old");
    EXPECT_THAT(desk.folder.names(), ElementsAre(name, "scene.toml"));
  }
}

TEST(Program, writes_the_files_it_can_when_another_fails) {
  const Desk desk;
  std::filesystem::create_symlink("/dev/full", desk / "full.png");
  const Outcome outcome = desk.render("full.png", {"-o", desk / "good.png"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(std::filesystem::exists(desk / "good.png"));
}

// ---- render

TEST(Render, writes_every_output_and_says_so_in_a_line) {
  const Desk desk;
  const Outcome outcome = desk.render("a.png", {"-o", desk / "b.exr", "-o", desk / "c.pfm"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, StartsWith((desk / "a.png") + ", "));
  EXPECT_THAT(outcome.out, HasSubstr("24 x 16, 16 spp, "));
  EXPECT_EQ(std::ranges::count(outcome.out, '\n'), 1);
  EXPECT_THAT(desk.folder.names(), ElementsAre("a.png", "b.exr", "c.pfm", "scene.toml"));
}

TEST(Render, keeps_how_it_was_made_in_exr_and_png) {
  const Desk desk;
  const Outcome outcome = desk.render(
      "a.png", {"-o", desk / "a.exr", "--seed", "77", "--estimator", "rees", "--isa", "scalar"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const std::string name : {"a.png", "a.exr"}) {
    auto kept = read_metadata(desk / name);
    EXPECT_EQ(kept["spp"], "16");
    EXPECT_EQ(kept["samples_per_ray"], "4");
    EXPECT_EQ(kept["first_sample"], "0");
    EXPECT_EQ(kept["seed"], "77");
    EXPECT_EQ(kept["estimator"], "rees");
    EXPECT_EQ(kept["isa"], "scalar");
    EXPECT_EQ(kept["version"], version());
    EXPECT_GT(std::stod(kept["seconds"]), 0);
  }
}

TEST(Render, warns_of_what_is_hardly_meant) {
  const Desk desk;
  const auto expect_warning = [&](std::vector<std::string> flags, const std::string& warning) {
    const Outcome outcome = desk.render("a.png", flags);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err.find("warning: " + warning), 0) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    flags.push_back("--quiet");
    EXPECT_EQ(desk.render("a.png", flags).err, "");
  };
  expect_warning({"-D", "media=[]", "-D", "objects=[]"}, "the scene is empty");
  expect_warning({"-D", "media.0.sigma_t=30"}, "fog is opaque after 0.15 m");
  expect_warning({"-D", "lights=[]"}, "no light");
  expect_warning({"-D", "objects.0.radius=2", "-D", "camera.position=[0, 0, 0.1]", "-D",
                  "objects.0.centre=[0, 0, 0]"},
                 "no light reaches the fog");
}

TEST(Render, is_silent_when_asked) {
  const Desk desk;
  const Outcome outcome = desk.render("a.png", {"--quiet"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

/// What a run shows on a terminal.
std::string on_terminal(const Desk& desk, std::vector<std::string> flags) {
  int terminal = 0, program = 0;
  if (openpty(&terminal, &program, nullptr, nullptr, nullptr) != 0) return "no terminal";
  std::string shown;
  desk.render("a.png", std::move(flags),
              {.before = [&] { dup2(program, STDERR_FILENO); },
               .during =
                   [&](pid_t) {
                     close(program);
                     char buffer[4096];
                     for (ssize_t n; (n = read(terminal, buffer, sizeof buffer)) > 0;)
                       shown.append(buffer, std::size_t(n));
                   }});
  close(terminal);
  return shown;
}

TEST(Render, shows_progress_on_a_terminal_and_takes_it_away) {
  const Desk desk;
  const std::string shown = on_terminal(desk, with(endless, {"--time-limit", "1"}));
  EXPECT_THAT(shown, HasSubstr(" elapsed | "));
  EXPECT_THAT(shown, HasSubstr(" remaining | "));
  EXPECT_THAT(shown, HasSubstr(" of 268435456 spp"));
  EXPECT_THAT(shown, EndsWith("\r\x1b[K"));
  EXPECT_THAT(shown, Not(HasSubstr("\n")));
}

TEST(Render, shows_no_progress_when_asked_to_be_quiet) {
  const Desk desk;
  EXPECT_EQ(on_terminal(desk, with(endless, {"--time-limit", "1", "--quiet"})), "");
}

TEST(Render, stops_at_a_time_limit_and_writes_what_is_done) {
  const Desk desk;
  const auto start = std::chrono::steady_clock::now();
  const Outcome outcome = desk.render("a.pfm", with(endless, {"--time-limit", "0.5"}));
  EXPECT_LT(std::chrono::steady_clock::now() - start, 60s);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr(" of 268435456 spp"));
  EXPECT_EQ(read_image(desk / "a.pfm").width, 64);
}

TEST(Render, writes_what_is_done_when_it_is_told_to_end) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const Desk desk;
    const Outcome outcome = desk.render(
        "a.pfm", with(endless, {"--preview", "0.1"}), {.during = [&](pid_t program) {
          // A preview says that rendering has begun.
          EXPECT_TRUE(wait_for([&] { return std::filesystem::exists(desk / "a.pfm"); }));
          std::filesystem::remove(desk / "a.pfm");
          kill(program, signal);
        }});
    EXPECT_EQ(outcome.status, 128 + signal) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(read_image(desk / "a.pfm").width, 64);
    EXPECT_THAT(desk.folder.names(), ElementsAre("a.pfm", "scene.toml"));
  }
}

TEST(Render, lives_through_a_control_c_that_it_was_told_to_ignore) {
  const Desk desk;
  const Outcome outcome = desk.render("a.pfm", with(endless, {"--preview", "0.1"}),
                                      {.before = [] { std::signal(SIGINT, SIG_IGN); },
                                       .during =
                                           [&](pid_t program) {
                                             const auto preview = [&] {
                                               return std::filesystem::exists(desk / "a.pfm");
                                             };
                                             for (const int signal : {SIGINT, SIGTERM}) {
                                               EXPECT_TRUE(wait_for(preview));
                                               std::filesystem::remove(desk / "a.pfm");
                                               kill(program, signal);
                                             }
                                           }});
  EXPECT_EQ(outcome.status, 128 + SIGTERM) << outcome.err;
}

TEST(Render, previews_again_and_again) {
  const Desk desk;
  const Beside watcher = {.during = [&](pid_t program) {
    for (int preview = 0; preview < 4; ++preview) {
      EXPECT_TRUE(wait_for([&] { return std::filesystem::exists(desk / "a.pfm"); }));
      EXPECT_EQ(read_image(desk / "a.pfm").width, 64);
      std::filesystem::remove(desk / "a.pfm");
    }
    kill(program, SIGTERM);
  }};
  desk.render("a.pfm", with(endless, {"--preview", "0.1"}), watcher);
}

TEST(Render, previews_without_a_number_of_seconds) {
  const Desk desk;
  const Outcome outcome =
      run({"render", "--preview", desk.scene, "-o", desk / "a.png", "--preview"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(desk.folder.names(), ElementsAre("a.png", "scene.toml"));
}

TEST(Render, gives_the_same_picture_for_any_number_of_threads_and_every_time) {
  const Desk desk;
  std::string first;
  for (const std::string threads : {"1", "2", "3", "3"}) {
    const Outcome outcome = desk.render("a.pfm", {"--threads", threads, "--size", "100x60"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::string bytes = bytes_of(desk / "a.pfm");
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first) << threads << " threads";
  }
}

TEST(Render, gives_other_noise_for_another_seed) {
  const Desk desk;
  desk.render("a.pfm", {"--seed", "1"});
  desk.render("b.pfm", {"--seed", "2"});
  EXPECT_NE(bytes_of(desk / "a.pfm"), bytes_of(desk / "b.pfm"));
}

TEST(Render, crops_what_the_whole_picture_shows) {
  const Desk desk;
  ASSERT_EQ(desk.render("whole.pfm").status, 0);
  ASSERT_EQ(desk.render("part.pfm", {"--crop", "7,3,10,5"}).status, 0);
  const Image whole = read_image(desk / "whole.pfm"), part = read_image(desk / "part.pfm");
  ASSERT_EQ(part.width, 10);
  ASSERT_EQ(part.height, 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 10; ++x)
      for (int c = 0; c < 3; ++c)
        // Lanes share camera rays in other blocks: the same numbers but for rounding.
        EXPECT_NEAR(part.at(x, y, c), whole.at(x + 7, y + 3, c), 1e-5F * whole.at(x + 7, y + 3, c));
}

TEST(Render, changes_values_of_the_scene) {
  const Desk desk;
  ASSERT_EQ(desk.render("a.pfm").status, 0);
  ASSERT_EQ(desk.render("b.pfm", {"-D", "lights.0.irradiance=40", "-D", "render.spp = 16"}).status,
            0);
  const Image a = read_image(desk / "a.pfm"), b = read_image(desk / "b.pfm");
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    EXPECT_FLOAT_EQ(b.pixels[i], 2 * a.pixels[i]);
    sum += a.pixels[i];
  }
  EXPECT_GT(sum, 0);
}

TEST(Render, takes_the_last_of_a_flag_given_twice_and_all_for_samples_per_ray) {
  const Desk desk;
  const Outcome outcome =
      desk.render("a.png", {"--spp", "4", "--spp", "8", "--samples-per-ray", "all"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(" 8 spp"));
  desk.render("all.pfm", {"--spp", "8", "--samples-per-ray=all"});
  desk.render("zero.pfm", {"--spp", "8", "--samples-per-ray", "0"});
  desk.render("four.pfm", {"--spp", "8", "--samples-per-ray", "4"});
  EXPECT_EQ(bytes_of(desk / "all.pfm"), bytes_of(desk / "zero.pfm"));
  EXPECT_NE(bytes_of(desk / "all.pfm"), bytes_of(desk / "four.pfm"));
}

TEST(Render, brightens_a_png_alone) {
  const Desk desk;
  ASSERT_EQ(desk.render("a.png", {"-o", desk / "a.pfm"}).status, 0);
  ASSERT_EQ(desk.render("b.png", {"-o", desk / "b.pfm", "--exposure", "-1.5"}).status, 0);
  EXPECT_EQ(bytes_of(desk / "a.pfm"), bytes_of(desk / "b.pfm"));
  EXPECT_NE(bytes_of(desk / "a.png"), bytes_of(desk / "b.png"));
}

// ---- compare

Outcome compare(const Desk& desk, std::vector<std::string> flags) {
  flags.insert(flags.begin(), {"compare", desk.scene, "-o", desk / "report"});
  if (std::ranges::find(flags, "--estimators") == flags.end())
    flags.insert(flags.end(), {"--estimators", "rm,rewv"});
  return run(flags);
}

TEST(Compare, writes_a_page_and_numbers) {
  const Desk desk;
  const Outcome outcome =
      compare(desk, {"--spp", "1,4", "--seeds", "2", "--reference-spp", "4096"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const std::string page = bytes_of(desk / "report/index.html");
  EXPECT_THAT(page, HasSubstr("rewv at 4096 spp with seeds of its own, whose RMSE is about"));
  EXPECT_THAT(page, HasSubstr("RMSE over samples"));
  EXPECT_THAT(bytes_of(desk / "report/results.csv"), HasSubstr("rewv"));
}

TEST(Compare, measures_what_is_named_twice_once) {
  const Desk desk;
  const Outcome outcome = compare(desk, {"--estimators", "rewv,rm,rewv", "--spp", "2,1,2",
                                         "--seeds", "1", "--reference-spp", "4"});
  EXPECT_THAT(outcome.out, EndsWith("index.html: 4 rows\n")) << outcome.err;
  const std::string table = bytes_of(desk / "report/results.csv");
  EXPECT_LT(table.find("rewv"), table.find("rm,")) << "in the order they were named";
}

TEST(Compare, of_equal_time_takes_no_more_samples_than_are_accepted) {
  const Desk desk;
  // One pixel that sees nothing but the background costs next to nothing.
  const Outcome outcome =
      compare(desk, {"--equal-time", "1e6", "--seeds", "1", "--reference-spp", "1", "--estimators",
                     "rm", "--size", "1x1", "-D", "camera.target=[0,0,9]"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(bytes_of(desk / "report/results.csv"), HasSubstr("\n16777216,rm,"));
}

TEST(Compare, plots_no_single_points) {
  const Desk desk;
  const Outcome outcome =
      compare(desk, {"--equal-time", "0.01", "--seeds", "1", "--reference-spp", "4096"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(bytes_of(desk / "report/index.html"), Not(HasSubstr("RMSE over")));
}

TEST(Compare, warns_of_a_reference_as_noisy_as_what_it_judges) {
  const Desk desk;
  const Outcome outcome = compare(desk, {"--spp", "1,64", "--seeds", "1", "--reference-spp", "64"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, StartsWith("warning: the reference is too noisy to judge "));
  EXPECT_THAT(outcome.err, HasSubstr("rewv at 64 spp"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("rm at 1 spp")));
  EXPECT_THAT(bytes_of(desk / "report/index.html"), HasSubstr("too noisy to judge"));
}

TEST(Compare, refuses_what_it_would_not_heed_or_cannot_trust) {
  const Desk desk;
  ASSERT_EQ(desk.render("a.png", {"-o", desk / "a.exr"}).status, 0);
  expect_refused(compare(desk, {"--reference", desk / "a.png"}),
                 "a.png: is a picture for a screen, its light clipped at white or tone-mapped; "
                 "accepted: .exr, .pfm or .hdr");
  expect_refused(compare(desk, {"--spp", "4", "--equal-time", "1"}),
                 "--spp 4: is not accepted beside --equal-time");
  expect_refused(compare(desk, {"--estimators", "rm,magic"}),
                 "--estimators magic: render.estimator = \"magic\" is not known here; accepted: ");
  EXPECT_FALSE(std::filesystem::exists(desk / "report"));
  EXPECT_EQ(compare(desk, {"--reference", desk / "a.exr", "--spp", "1", "--seeds", "1"}).status, 0);
}

TEST(Compare, reads_its_reference_once) {
  const Desk desk;
  ASSERT_EQ(desk.render("a.exr").status, 0);
  const std::string picture = bytes_of(desk / "a.exr");
  ASSERT_LT(picture.size(), 1 << 16);  // it fits into a pipe
  const Outcome outcome = run({"compare", desk.scene, "-o", desk / "report", "--reference",
                               "/dev/stdin", "--spp", "1", "--seeds", "1", "--estimators", "rewv"},
                              {.before = [&] {
                                int ends[2];
                                if (pipe(ends) != 0) _exit(1);
                                if (write(ends[1], picture.data(), picture.size()) < 0) _exit(1);
                                close(ends[1]);
                                dup2(ends[0], STDIN_FILENO);
                              }});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

// ---- probe and info

TEST(Probe, prints_json_that_tells_what_the_picture_shows) {
  const Desk desk;
  ASSERT_EQ(desk.render("a.pfm", {"--isa", "double"}).status, 0);
  const Image picture = read_image(desk / "a.pfm");
  const Outcome outcome = run({"probe", desk.scene, "--pixel", "16,5", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(picture.at(16, 5, c), 0);
    EXPECT_NEAR(json["radiance"][c], picture.at(16, 5, c), 1e-6 * picture.at(16, 5, c));
  }
  EXPECT_EQ(json["rays"].size(), 4u);
  EXPECT_EQ(json["rays"][0]["lights"][0]["samples"].size(), 4u);
}

TEST(Probe, explains_in_words) {
  const Desk desk;
  const Outcome outcome = run({"probe", desk.scene, "--pixel", "12,8"});
  EXPECT_EQ(outcome.status, 0);
  for (const char* word : {"meets \"sphere\" at ", "in the medium from ", "trapezoids",
                           "lit: ", "pdf", "visibility", "plain", "unoccluded", "radiance"})
    EXPECT_THAT(outcome.out, HasSubstr(word));
}

TEST(Probe, says_in_one_line_that_it_shows_single_scattering_only) {
  const Desk desk;
  const std::string once = run({"probe", desk.scene, "--pixel", "12,8"}).out;
  const std::string often = run({"probe", desk.scene, "--pixel", "12,8", "--max-depth", "8"}).out;
  const std::string note =
      "# shows light that scatters once; the picture also has what scatters up to 8 times\n";
  const std::size_t second = once.find('\n') + 1;
  EXPECT_EQ(often, once.substr(0, second) + note + once.substr(second));
  const Outcome json = run({"probe", desk.scene, "--pixel", "12,8", "--max-depth", "8", "--json"});
  EXPECT_EQ(nlohmann::json::parse(json.out)["max_depth"], 8);
}

TEST(Probe, explains_one_ray_when_asked) {
  const Desk desk;
  const Outcome outcome = run({"probe", desk.scene, "--pixel", "12,8", "--ray", "2"});
  EXPECT_THAT(outcome.out, HasSubstr("ray 2: "));
  EXPECT_THAT(outcome.out, Not(HasSubstr("ray 0: ")));
}

TEST(Probe, plots_a_ray) {
  const Desk desk;
  const Outcome outcome = run({"probe", desk.scene, "--pixel", "12,8", "-o", desk / "ray.svg"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(bytes_of(desk / "ray.svg"), StartsWith("<svg"));
  EXPECT_THAT(outcome.out, HasSubstr("trapezoids"));
  const Outcome quiet =
      run({"probe", desk.scene, "--pixel", "12,8", "-o", desk / "quiet.svg", "--quiet"});
  EXPECT_EQ(quiet.status, 0) << quiet.err;
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_EQ(bytes_of(desk / "quiet.svg"), bytes_of(desk / "ray.svg"));
}

TEST(Probe, refuses_what_is_not_there) {
  const Desk desk;
  const auto probe = [&](std::vector<std::string> flags) {
    flags.insert(flags.begin(), {"probe", desk.scene});
    return run(flags);
  };
  expect_refused(probe({"--pixel", "24,0"}),
                 "pixel 24,0 is not in the picture; accepted: 0,0 to 23,15");
  expect_refused(probe({"--pixel", "1;2"}), "--pixel 1;2: is no pixel");
  expect_refused(probe({"--pixel", "1,2", "-o", desk / "ray.png"}), "accepted: .svg");
  expect_refused(probe({"--pixel", "12,8", "-o", desk / "ray.svg", "--ray", "4"}),
                 "accepted: 0 to 3");
  expect_refused(probe({"--pixel", "0,0", "-o", desk / "ray.svg"}), "nothing to plot");
  EXPECT_THAT(desk.folder.names(), ElementsAre("scene.toml"));
}

TEST(Info, tells_what_is_in_a_scene_and_warns) {
  const Desk desk;
  const Outcome outcome = run({"info", desk.scene, "-D", "ambient=0.1"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const char* word :
       {"1 spheres", "sigma_t [0.3, 1, 3] /m", "mean free path [3.333, 1, 0.3333] m",
        "optical depth [0.6, 2, 6] across", "outside the medium", "lights.0",
        "the camera is outside the fog", "ambient lights surfaces only"})
    EXPECT_THAT(outcome.out, HasSubstr(word));
}

TEST(Info, tells_the_outlines_and_groups_of_lights) {
  const Outcome outcome = run({"info", AIRLIGHT_SOURCE_DIR "/scenes/stage.toml"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* words :
       {"begins at (-4.2, 4.75, -2.35) m as a circle of radius 0.2 m", "in the group rosettes",
        "as a polygon of 3 sides, 1.08 m x 0.93 m", "passes through an image of 256 x 256 pixels"})
    EXPECT_THAT(outcome.out, HasSubstr(words));
}

}  // namespace
}  // namespace airlight::test
