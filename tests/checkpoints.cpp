// Sums in files: a render that was stopped or killed goes on where it was, and parts of a render
// add up to the whole, as if it had been made in one go.
#include "render/checkpoint.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <random>
#include <thread>

#include "error.h"
#include "image/input.h"
#include "render/checkpoint_keeper.h"
#include "render/render.h"
#include "scene/load_scene.h"
#include "support/error_of.h"
#include "support/refused.h"
#include "support/scene_desk.h"

namespace airlight::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

/// Two groups of light on a ball in RGB fog; no multiple of a tile or a block.
constexpr const char* scene_text = R"(
background = [0.3, 0.2, 0.1]
[camera]
position = [0, 0.2, 3.1]
target = [0, 0, 0]
[image]
width = 53
height = 37
[[media]]
albedo = 0.9
sigma_t = [0.3, 1, 3]
shape = {type = "box", min = [-1, -1, -1], max = [1, 1, 1]}
[[lights]]
type = "directional"
irradiance = 20
direction = [-1, -1, 0.2]
group = "sun"
[[lights]]
type = "directional"
irradiance = [1, 2, 3]
direction = [1, -0.3, 0.2]
[[objects]]
type = "sphere"
radius = 0.7
)";

Scene scene_with(const std::vector<Override>& changes = {}) {
  return parse_scene(scene_text, "scene.toml", changes);
}

/// The largest difference of any two sums of two films, relative to the mean of such sums; their
/// counts and what is not a sum must be the same.
double largest_difference(const Film& a, const Film& b) {
  double worst = 0;
  for (int group = 0; group < a.layout.groups; ++group) {
    const auto numbers = [&](const Film& film, std::size_t i) {
      const PixelSums p = film.pixel(i, group);
      EXPECT_EQ(p.samples, a.pixel(i, group).samples) << i;
      EXPECT_EQ(p.depth, a.pixel(i, group).depth) << i;
      EXPECT_EQ(p.object, a.pixel(i, group).object) << i;
      std::vector<double> all;
      for (const Estimate<double>& e : p.in_scatter)
        for (const Rgb<double>& c : {e.plain, e.analytic, e.occluded, e.unoccluded})
          all.insert(all.end(), {c.r, c.g, c.b});
      const auto& [seen, plate] = p.holdouts;
      const auto& [lit, was_lit] = p.holdout_light;
      for (const Rgb<double>& c : {p.surface, p.transmittance, p.albedo, seen, plate, lit, was_lit})
        all.insert(all.end(), {c.r, c.g, c.b});
      all.insert(all.end(), {p.normal.x, p.normal.y, p.normal.z});
      return all;
    };
    std::vector<double> mean(numbers(a, 0).size());
    for (std::size_t i = 0; i < a.pixel_count(); ++i) {
      const auto row = numbers(a, i);
      for (std::size_t k = 0; k < row.size(); ++k)
        mean[k] += std::abs(row[k]) / double(a.pixel_count());
    }
    for (std::size_t i = 0; i < a.pixel_count(); ++i) {
      const auto x = numbers(a, i), y = numbers(b, i);
      for (std::size_t k = 0; k < x.size(); ++k)
        if (x[k] != y[k])
          worst = std::max(worst, std::abs(x[k] - y[k]) / std::max(std::abs(x[k]), mean[k]));
    }
  }
  return worst;
}

bool same_bits(const Film& a, const Film& b) {
  std::vector<std::byte> x, y;
  for (int tile = 0; tile < a.tile_count(); ++tile) {
    x.resize(a.tile_bytes(tile)), y.resize(b.tile_bytes(tile));
    a.save_tile(tile, x.data()), b.save_tile(tile, y.data());
    if (x != y) return false;
  }
  return a.runs[0].counts == b.runs[0].counts;
}

/// A film and its parts add up the same floats in another order.
constexpr double rounding = 3e-6;

/// Renders into a checkpoint, from what it holds.
Rendered render(const Scene& scene, const std::string& file, RenderControl control = {}) {
  control.checkpoint = {.file = file, .resume = true, .on_failure = {}};
  return Renderer(scene).render(scene.render, control);
}

TEST(Checkpoint, holds_a_film_bit_for_bit) {
  const Folder folder;
  const Scene scene = scene_with({"render.spp=8", "render.seed=5", "render.first_sample=16"});
  RenderControl control;
  control.crop = PixelRect{3, 5, 35, 17};
  const Rendered done = render(scene, folder / "a.ckpt", control);
  const Checkpoint read = read_checkpoint(folder / "a.ckpt");
  EXPECT_TRUE(same_bits(read.film, done.film));
  EXPECT_EQ(part_of(read.film), "35 x 17 pixels at 3,5 of 53 x 37");
  EXPECT_EQ(read.film.groups, (std::vector<std::string>{"", "sun"}));
  ASSERT_EQ(read.film.runs.size(), 1u);
  EXPECT_EQ(read.film.runs[0].seed, 5u);
  EXPECT_EQ(read.film.runs[0].first, 16u);
  EXPECT_EQ(read.film.runs[0].counts, std::vector<std::uint32_t>(6, 8));
  EXPECT_EQ(read.origin.traits, traits_of(scene, scene.render));
  EXPECT_EQ(read.origin.instruction_set, done.instruction_set);
  EXPECT_GT(read.origin.seconds, 0);
  EXPECT_THAT(folder.names(), ElementsAre("a.ckpt"));
}

TEST(Checkpoint, is_written_again_and_again_while_a_pass_goes_on) {
  const Folder folder;
  const std::string file = folder / "a.ckpt";
  const Scene scene = scene_with({"render.spp=64", "render.threads=2", "render.max_depth=4",
                                  "image.width=212", "image.height=148"});
  int written = 0;
  std::filesystem::file_time_type last{};
  const auto is_written_again = [&] {
    std::error_code none_yet;
    const auto time = std::filesystem::last_write_time(file, none_yet);
    return !none_yet && std::exchange(last, time) != time;
  };
  RenderControl control;
  control.checkpoint = {.file = file, .every = 0.01, .on_failure = {}};
  control.on_progress = [&](const Progress& progress) {
    if (progress.fraction < 1 && written < 5 && wait_for(is_written_again)) ++written;
  };
  EXPECT_TRUE(Renderer(scene).render(scene.render, control).complete);
  EXPECT_EQ(written, 5);
}

TEST(Checkpoint, that_cannot_be_written_is_told_once_and_at_the_end) {
  const Folder folder;
  std::filesystem::create_directory(folder / "inner");
  const Scene scene = scene_with({"render.spp=1024", "render.threads=2"});
  int failures = 0;
  RenderControl control;
  control.checkpoint = {.file = folder / "inner/a.ckpt", .every = 0.01, .on_failure = {}};
  control.checkpoint->on_failure = [&](const Error&) { ++failures; };
  control.on_progress = [&](const Progress&) {
    std::filesystem::remove_all(folder / "inner");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  };
  EXPECT_FALSE(Renderer(scene).render(scene.render, control).kept);
  EXPECT_GE(failures, 1);
  EXPECT_LE(failures, 2);
}

TEST(Checkpoint, waits_for_no_more_than_128_samples_of_a_tile) {
  const Folder folder;
  const Scene scene = scene_with({"render.spp=1024", "image.width=16", "image.height=9"});
  std::vector<double> fractions = {0};
  RenderControl control;
  control.checkpoint = {.file = folder / "a.ckpt", .on_failure = {}};
  control.on_progress = [&](const Progress& p) { fractions.push_back(p.fraction); };
  EXPECT_TRUE(Renderer(scene).render(scene.render, control).complete);
  for (std::size_t i = 1; i < fractions.size(); ++i)  // of its only tile
    EXPECT_LE(fractions[i] - fractions[i - 1], 128. / 1024);
  EXPECT_EQ(fractions.back(), 1);
}

TEST(CheckpointKeeper, tells_whatever_keeps_it_from_writing) {
  const Folder folder;
  const Scene scene = scene_with({"render.spp=1"});
  const Film film = Renderer(scene).render(scene.render).film;
  std::atomic<int> failures = 0;
  std::string told;
  const auto on_failure = [&](const Error& error) {
    if (failures++ == 0) told = error.what();
  };
  CheckpointKeeper keeper({.file = folder / "a.ckpt", .every = 0.01, .on_failure = on_failure},
                          film, {}, []() -> Origin { throw std::bad_alloc(); });
  EXPECT_TRUE(wait_for([&] { return failures > 0; }));  // by the keeper's own thread
  EXPECT_FALSE(keeper.finish());
  EXPECT_EQ(told, (folder / "a.ckpt").string() + ": cannot be written: std::bad_alloc");
  EXPECT_THAT(folder.names(), ElementsAre());
}

TEST(Checkpoint, stays_whole_where_a_caller_ends_the_render_by_an_exception) {
  const Folder folder;
  const Scene scene = scene_with({"render.spp=64", "render.threads=2"});
  RenderControl control;
  control.checkpoint = {.file = folder / "a.ckpt", .every = 0.01, .on_failure = {}};
  control.on_progress = [&](const Progress&) {
    if (wait_for([&] { return std::filesystem::exists(folder / "a.ckpt"); }))
      throw std::runtime_error("enough");
  };
  EXPECT_THROW(Renderer(scene).render(scene.render, control), std::runtime_error);
  EXPECT_NO_THROW(read_checkpoint(folder / "a.ckpt"));
}

TEST(FairMutex, lets_who_waits_come_before_who_let_it_go) {
  FairMutex mutex;
  std::atomic<bool> held = false;
  int turns = 0;
  std::jthread greedy([&](const std::stop_token& stop) {
    while (turns < 10'000 && !stop.stop_requested()) {
      const std::scoped_lock lock(mutex);
      ++turns, held = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  while (!held) std::this_thread::yield();
  {
    const std::scoped_lock lock(mutex);
    EXPECT_LT(turns, 10'000);
  }
  greedy.request_stop();
}

TEST(Resume, of_a_render_stopped_anywhere_gives_what_it_would_have_been) {
  for (const char* estimator : {"rewv", "mcds"}) {
    const Folder folder;
    const Scene scene =
        scene_with({std::string("render.estimator=") + estimator, "render.spp=300"});
    const Film whole = std::move(Renderer(scene).render(scene.render).film);
    int stops = 0;
    for (bool complete = false; !complete; ++stops) {
      std::stop_source stop;
      RenderControl control;
      control.stop = stop.get_token();
      control.on_progress = [&, tiles = 0](const Progress&) mutable {
        if (++tiles > 2 + 3 * stops) stop.request_stop();  // in the middle of a pass
      };
      const Rendered part = render(scene, folder / "a.ckpt", control);
      complete = part.complete;
      EXPECT_LE(part.samples, 300);
      if (complete) {
        EXPECT_LT(largest_difference(part.film, whole), rounding);
      }
    }
    EXPECT_GT(stops, 3);
  }
}

TEST(Merge, tells_that_some_pixels_have_more_samples_than_others) {
  const Folder folder;
  std::stop_source stop;
  RenderControl control;
  control.stop = stop.get_token();
  control.on_progress = [&](const Progress&) { stop.request_stop(); };
  const Rendered part = render(scene_with({"render.spp=96"}), folder / "a.ckpt", control);
  EXPECT_EQ(part.film.samples(), 0);
  EXPECT_GT(part.film.most_samples(), 0);
  const Outcome merged = run({"merge", folder / "a.ckpt", "-o", folder / "a.png"});
  EXPECT_THAT(merged.out,
              HasSubstr(fmt::format(", 0 to {} spp of 1 file", part.film.most_samples())));
}

TEST(Resume, changes_no_bit_where_passes_end_where_they_would_have) {
  for (const char* holdout : {"objects.0.holdout=false", "objects.0.holdout=true"}) {
    const Folder folder;
    for (const char* spp : {"64", "128", "256"})
      render(scene_with({std::string("render.spp=") + spp, holdout}), folder / "a.ckpt");
    const Scene scene = scene_with({"render.spp=256", holdout});
    const Film film = read_checkpoint(folder / "a.ckpt").film;
    EXPECT_TRUE(same_bits(film, Renderer(scene).render(scene.render).film)) << holdout;
    EXPECT_EQ(film.layout.shadow, scene.objects[0].holdout);
  }
}

/// The square of the standard error, over all pixels.
double square_error(const Film& film) {
  const Image error = film.layer("standard_error");
  double sum = 0;
  for (int y = 0; y < error.height; ++y)
    for (const float e : error.row(y)) sum += double(e) * e;
  return sum;
}

TEST(Resume, of_few_samples_through_the_centre_goes_on_there_or_says_how_to) {
  for (const char* sun : {"lights.0.angular_diameter=0", "lights.0.angular_diameter=2"}) {
    const Folder folder;
    const std::string file = folder / "a.ckpt";
    EXPECT_GT(square_error(render(scene_with({sun, "render.spp=4"}), file).film), 0) << sun;
    EXPECT_EQ(error_of([&] {
                render(scene_with({sun, "render.spp=64"}), file);
              }),
              file +
                  ": holds samples through the centres of pixels, as --spp up to 4 takes them; "
                  "accepted: --samples-per-ray all, to go on there, or a new file, with "
                  "--first-sample 0 from the start");
    EXPECT_THAT(error_of([&] {
                  render(scene_with({sun, "render.spp=64", "media.0.albedo=0.8"}), file);
                }),
                EndsWith("is of another render: not the same media"));
    // The halves, too, are those of a longer render.
    const Scene centred = scene_with({sun, "render.spp=64", "render.samples_per_ray=0"});
    const Film whole = Renderer(centred).render(centred.render).film;
    const Film resumed = render(centred, file).film;
    EXPECT_LT(largest_difference(resumed, whole), rounding) << sun;
    EXPECT_NEAR(square_error(resumed) / square_error(whole), 1, 1e-3) << sun;

    const std::string spread = folder / "b.ckpt";
    render(scene_with({sun, "render.spp=4", "render.first_sample=0"}), spread);
    const Scene longer = scene_with({sun, "render.spp=64"});
    EXPECT_LT(largest_difference(render(longer, spread).film,
                                 Renderer(longer).render(longer.render).film),
              rounding)
        << sun;
  }
}

TEST(Resume, counts_all_time_and_starts_no_ray_when_all_is_done) {
  const Folder folder;
  const Scene scene = scene_with({"render.spp=64"});
  const double first = render(scene, folder / "a.ckpt").seconds;
  RenderControl control;
  control.on_progress = [](const Progress&) { ADD_FAILURE() << "a tile is rendered"; };
  const Rendered again = render(scene, folder / "a.ckpt", control);
  EXPECT_TRUE(again.complete);
  EXPECT_EQ(again.samples, 64);
  EXPECT_GE(again.seconds, first);
}

TEST(Resume, refuses_what_is_another_render) {
  const Folder folder;
  const std::string file = folder / "a.ckpt";
  render(scene_with({"render.spp=8"}), file);
  const std::string before = bytes_of(file);
  const struct {
    std::vector<Override> changes;
    std::string said;
  } cases[] = {
      {{"image.width=54"}, "is of another render: image is 53 x 37, not 54 x 37"},
      {{"camera.fov=41"}, "is of another render: not the same camera"},
      {{"background=0"}, "is of another render: not the same background"},
      {{"ambient=0.1"}, "is of another render: not the same ambient"},
      {{"media.0.albedo=0.8"}, "is of another render: not the same media"},
      {{"lights.1.irradiance=1"}, "is of another render: not the same lights"},
      {{"lights.0.group=moon"}, "is of another render: not the same lights"},
      {{"objects.0.radius=0.71"}, "is of another render: not the same objects"},
      {{"render.estimator=mcwvds"}, "is of another render: render.estimator is rewv, not mcwvds"},
      {{"render.filter=box"}, "is of another render: render.filter is tent, not box"},
      {{"render.samples_per_ray=2"}, "is of another render: render.samples_per_ray is 4, not 2"},
      {{"render.spp=4"}, "is of another render: render.samples_per_ray is 4, not all"},
      {{"render.seed=1"}, "holds samples of seed 0 from 0 on; this render takes those of seed 1"},
      {{"render.first_sample=8"}, "this render takes those of seed 0 from 8 on"},
      {{"render.spp=7"}, "holds 8 samples a pixel already; accepted: --spp 8 or more"},
  };
  for (const auto& [changes, said] : cases) {
    std::vector<Override> all = {"render.spp=8"};
    all.insert(all.end(), changes.begin(), changes.end());
    const Scene scene = scene_with(all);
    EXPECT_THAT(error_of([&] { render(scene, file); }),
                AllOf(testing::StartsWith(file + ": "), HasSubstr(said)));
  }
  RenderControl control;
  control.crop = PixelRect{0, 0, 16, 16};
  EXPECT_THAT(error_of([&] { render(scene_with({"render.spp=8"}), file, control); }),
              HasSubstr("holds 53 x 37 pixels at 0,0 of 53 x 37; this render has 16 x 16 pixels"));
  EXPECT_EQ(bytes_of(file), before);
  for (const char* same : {"render.threads=1", "render.isa=baseline"})
    EXPECT_EQ(error_of([&] { render(scene_with({"render.spp=8", same}), file); }), "");
}

TEST(Traits, tell_textures_apart) {
  const Scene plain = scene_with();
  Scene textured = plain;
  textured.textures.push_back({1, 1, {255, 255, 255, 255}});
  Scene other = textured;
  other.textures[0].rgba[2] = 254;
  const auto traits = [](const Scene& scene) { return traits_of(scene, scene.render); };
  EXPECT_EQ(difference(traits(plain), traits(textured)), "not the same textures");
  EXPECT_EQ(difference(traits(other), traits(textured)), "not the same textures");
  EXPECT_EQ(difference(traits(other), traits(other)), "");
}

TEST(Traits, tell_whether_a_background_is_shown) {
  const auto traits = [](const std::string& background, bool is_seen) {
    Scene scene = scene_with({"background=" + background});
    scene.background_is_seen = is_seen;
    return traits_of(scene, scene.render);
  };
  EXPECT_EQ(difference(traits("0.1", true), traits("0.1", false)),
            "what is behind is shown, not left out");
  EXPECT_EQ(difference(traits("0", true), traits("0", false)), "");
}

/// Checkpoints of ranges of samples: (seed, first, count).
std::string part(const Folder& folder, int seed, int first, int count) {
  const std::string name = fmt::format("{}-{}-{}.ckpt", seed, first, count);
  render(
      scene_with({fmt::format("render.seed={}", seed), fmt::format("render.first_sample={}", first),
                  fmt::format("render.spp={}", count)}),
      folder / name);
  return folder / name;
}

Checkpoint sum_of(const std::vector<std::string>& files) {
  Checkpoint sum = read_checkpoint(files[0]);
  for (std::size_t i = 1; i < files.size(); ++i) merge(sum, read_checkpoint(files[i]));
  return sum;
}

TEST(Merge, of_ranges_is_the_whole_in_any_order) {
  const Folder folder;
  const std::string a = part(folder, 0, 0, 16), b = part(folder, 0, 16, 16),
                    c = part(folder, 0, 32, 32);
  const Film whole = read_checkpoint(part(folder, 0, 0, 64)).film;
  for (const auto& files : {std::vector{a, b, c}, {c, a, b}, {b, c, a}}) {
    const Checkpoint sum = sum_of(files);
    EXPECT_LT(largest_difference(sum.film, whole), rounding);
    ASSERT_EQ(sum.film.runs.size(), 1u);  // and can be resumed
    EXPECT_EQ(sum.film.runs[0].counts, whole.runs[0].counts);
    EXPECT_EQ(sum.film.samples(), 64);
  }
  EXPECT_EQ(sum_of({a, c}).film.runs.size(), 2u);
}

TEST(Merge, of_seeds_weighs_them_by_their_samples) {
  const Folder folder;
  const std::string a = part(folder, 3, 0, 16), b = part(folder, 7, 0, 48);
  const Film x = read_checkpoint(a).film, y = read_checkpoint(b).film;
  const Film sum = sum_of({b, a}).film;
  EXPECT_EQ(sum.samples(), 64);
  for (std::size_t i = 0; i < sum.pixel_count(); i += 7)
    for (int c = 0; c < 3; ++c) {
      const auto mean = [&](const Film& film) { return mean_estimate(film.pixel(i, 1)); };
      const double weighted = 0.25 * mean(x).occluded[c] + 0.75 * mean(y).occluded[c];
      EXPECT_NEAR(mean(sum).occluded[c], weighted, 1e-9 * (1 + weighted));
    }
}

TEST(Merge, refuses_what_does_not_belong_together) {
  const Folder folder;
  const std::string a = part(folder, 0, 0, 16);
  EXPECT_THAT(error_of([&] {
                sum_of({a, a});
              }),
              HasSubstr("samples 0 to 15 of seed 0 are there twice; accepted: ranges that do not"));
  EXPECT_THAT(error_of([&] {
                sum_of({a, part(folder, 0, 8, 16)});
              }),
              HasSubstr("samples 8 to 15 of seed 0 are there twice"));
  render(scene_with({"render.first_sample=16", "lights.0.irradiance=21"}), folder / "lit.ckpt");
  EXPECT_THAT(error_of([&] {
                sum_of({a, folder / "lit.ckpt"});
              }),
              HasSubstr("not the same lights"));
  render(scene_with({"render.first_sample=16", "image.width=52"}), folder / "wide.ckpt");
  EXPECT_THAT(error_of([&] {
                sum_of({a, folder / "wide.ckpt"});
              }),
              HasSubstr("image is 52 x 37, not 53 x 37"));
  RenderControl control;
  control.crop = PixelRect{1, 0, 52, 37};
  render(scene_with({"render.first_sample=16"}), folder / "crop.ckpt", control);
  EXPECT_THAT(error_of([&] { sum_of({a, folder / "crop.ckpt"}); }), HasSubstr("at 1,0"));
}

TEST(Checkpoint, is_refused_when_cut_short_or_damaged_anywhere) {
  const Folder folder;
  const std::string file = folder / "a.ckpt", bad = folder / "bad.ckpt";
  render(scene_with({"render.spp=4", "image.width=17", "image.height=3"}), file);
  const std::string bytes = bytes_of(file);
  const auto error = [&](const std::string& content) {
    write_bytes(bad, content);
    return error_of([&] { read_checkpoint(bad); });
  };
  EXPECT_EQ(error(bytes), "");
  EXPECT_EQ(error(""), bad + ": is no checkpoint of Airlight");
  EXPECT_EQ(error("airlight"), bad + ": is no checkpoint of Airlight");
  EXPECT_EQ(error(bytes.substr(0, bytes.size() - 1)),
            fmt::format("{}: is cut short: {} of {} bytes", bad, bytes.size() - 1, bytes.size()));
  EXPECT_EQ(error(bytes + "x"),
            fmt::format("{}: is damaged: {} bytes, not {}", bad, bytes.size() + 1, bytes.size()));
  for (std::size_t size = 1; size < bytes.size(); size += 1 + size / 20)
    EXPECT_NE(error(bytes.substr(0, size)), "") << size << " bytes";
  for (std::size_t i = 0; i < bytes.size(); i += 1 + i / 50) {
    std::string damaged = bytes;
    damaged[i] = char(damaged[i] ^ 4);
    EXPECT_NE(error(damaged), "") << "byte " << i;
  }
  std::string newer = bytes;
  newer[20] = 4;
  EXPECT_EQ(error(newer), bad + ": is a checkpoint of format 4; accepted: 3");
  EXPECT_THAT(error_of([&] { read_checkpoint(folder / "no.ckpt"); }),
              EndsWith("no.ckpt: cannot be read: No such file or directory"));
}

// --- the program ---------------------------------------------------------------------------------

struct Desk : SceneDesk {
  Desk() : SceneDesk("scene.toml", scene_text) {}
};

TEST(Merge, writes_no_alpha_of_a_picture_with_a_background) {
  const Folder folder;
  for (const char* background : {"0", "0.1"})
    render(scene_with({std::string("background=") + background}), folder / background);
  EXPECT_EQ(run({"merge", folder / "0", "--alpha", "-o", folder / "a.exr"}).status, 0);
  expect_refused(run({"merge", folder / "0.1", "--alpha", "-o", folder / "b.exr"}),
                 "/0.1: holds a background, which --alpha cannot take out; accepted: ");
  EXPECT_FALSE(std::filesystem::exists(folder / "b.exr"));
}

TEST(Program, goes_on_with_a_render_and_merges_its_parts) {
  const Desk desk;
  const auto render = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"render", desk.scene, "--exr", "float"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  EXPECT_EQ(render({"-o", desk / "whole.exr", "--spp", "96"}).status, 0);
  EXPECT_EQ(render({"-o", desk / "a.png", "--spp", "32", "--checkpoint", desk / "a.ckpt"}).status,
            0);
  expect_refused(render({"-o", desk / "a.png", "--checkpoint", desk / "a.ckpt"}),
                 "a.ckpt: is there already; accepted: a new file, or --resume to go on with it");
  expect_refused(render({"-o", desk / "a.png", "--resume"}), "--resume: which file?");
  expect_refused(render({"-o", desk / "a.png", "--checkpoint-every", "3"}),
                 "--checkpoint-every 3: of which file?");
  const auto resumed =
      render({"-o", desk / "a.exr", "--spp", "64", "--checkpoint", desk / "a.ckpt", "--resume"});
  EXPECT_THAT(resumed.out, HasSubstr(" 64 spp, ")) << resumed.err;
  EXPECT_EQ(render({"-o", desk / "b.png", "--spp", "32", "--first-sample", "64", "--checkpoint",
                    desk / "b.ckpt"})
                .status,
            0);

  const auto merged = run({"merge", desk / "b.ckpt", desk / "a.ckpt", "-o", desk / "sum.exr", "-o",
                           desk / "sum.CKPT", "-o", desk / "sum.png", "--exr", "float"});
  EXPECT_EQ(merged.err, "");
  EXPECT_THAT(merged.out, HasSubstr("53 x 37, 96 spp of 2 files, "));
  const Image sum = read_image(desk / "sum.exr"), whole = read_image(desk / "whole.exr");
  for (std::size_t i = 0; i < sum.pixels.size(); ++i)
    EXPECT_NEAR(sum.pixels[i], whole.pixels[i], 1e-5F * whole.pixels[i]) << i;
  auto said = read_metadata(desk / "sum.exr");
  EXPECT_EQ(said["spp"], "96");
  EXPECT_EQ(said["seed"], "0");
  EXPECT_EQ(said["estimator"], "rewv");
  EXPECT_EQ(read_checkpoint(desk / "sum.CKPT").film.samples(), 96);

  render({"-o", desk / "c.png", "--seed", "9", "--checkpoint", desk / "c.ckpt"});
  EXPECT_THAT(run({"merge", desk / "a.ckpt", desk / "c.ckpt", "-o", desk / "two.exr"}).out,
              HasSubstr("80 spp of 2 files"));
  EXPECT_EQ(read_metadata(desk / "two.exr")["seed"], "0, 9");

  const std::vector<std::string> before = desk.folder.names();
  expect_refused(run({"merge", desk / "a.ckpt", desk / "sum.CKPT", "-o", desk / "no.exr"}),
                 "sum.CKPT: cannot be added to " + (desk / "a.ckpt") +
                     ": samples 0 to 63 of seed 0 are there twice");
  expect_refused(run({"merge", desk.scene, "-o", desk / "no.exr"}),
                 "scene.toml: is no checkpoint of Airlight");
  expect_refused(run({"merge", desk / "a.ckpt", "-o", desk / "no.ckpt", "-o", desk / "no.ckpt"}),
                 "no.ckpt: would be written twice");
  expect_refused(run({"merge", desk / "a.ckpt", "-o", desk / "no.jpg"}),
                 "no.jpg: unknown picture format \".jpg\"; accepted: .exr, .pfm, .png, .ckpt");
  EXPECT_EQ(desk.folder.names(), before);
}

// Whatever moment it is killed at, the file is whole, and what it held is never lost.
TEST(Program, killed_fifty_times_ends_with_the_picture_that_it_would_have_made) {
  const Desk desk;
  const std::string file = desk / "a.ckpt";
  const std::vector<std::string> words = {
      "render", desk.scene,     "-o", desk / "a.exr",       "--spp", "16384",    "--threads",
      "2",      "--checkpoint", file, "--checkpoint-every", "0.01",  "--resume", "--exr",
      "float"};
  using Clock = std::chrono::steady_clock;
  Clock::duration to_first{};  // checkpoint: a life of this length is likely to write one
  const auto first_life = [&](pid_t child) {
    const auto start = Clock::now();
    while (!std::filesystem::exists(file))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    to_first = Clock::now() - start;
    kill(child, SIGKILL);
  };
  EXPECT_EQ(run(words, {.during = first_life}).status, 1000 + SIGKILL);

  std::mt19937 random(1);
  std::uniform_real_distribution<double> times(0.2, 2.5);
  int kills = 1, progressed = 0;
  std::int64_t sum = 0;
  while (kills < 50) {
    const auto life = times(random) * to_first;
    const Outcome outcome = run(words, {.during = [&](pid_t child) {
                                  std::this_thread::sleep_for(life);
                                  kill(child, SIGKILL);
                                }});
    ASSERT_TRUE(outcome.status == 0 || outcome.status == 1000 + SIGKILL) << outcome.err;
    kills += outcome.status != 0;
    std::int64_t now = 0;
    if (std::filesystem::exists(file)) {
      const Checkpoint kept = read_checkpoint(file);
      for (const std::uint32_t count : kept.film.runs[0].counts) now += count;
    }
    EXPECT_GE(now, sum);
    progressed += now > sum;
    sum = now;
    if (outcome.status == 0) std::filesystem::remove(file), sum = 0;
  }
  EXPECT_GT(progressed, 0);
  const Outcome last = run(words);
  ASSERT_EQ(last.status, 0) << last.err;
  EXPECT_THAT(desk.folder.names(), ElementsAre("a.ckpt", "a.exr", "scene.toml"));

  const Scene scene = scene_with({"render.spp=16384"});
  EXPECT_LT(
      largest_difference(read_checkpoint(file).film, Renderer(scene).render(scene.render).film),
      rounding);
}

}  // namespace
}  // namespace airlight::test
