#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "error.h"
#include "image/atomic_file.h"
#include "image/output.h"
#include "image/read_file.h"
#include "render/version.h"
#include "report/csv.h"
#include "report/page.h"
#include "report/svg.h"
#include "study/comparison.h"

namespace airlight {
namespace {

Table table_of(const Comparison& comparison) {
  Table table;
  table.caption =
      "Means over the seeds, ± their standard deviation; the best of each sample count is bold.";
  table.columns = {{.name = "spp"},
                   {.name = "estimator"},
                   {.name = "seconds", .unit = "s", .best = Best::lowest}};
  for (const Metric& metric : metric_list)
    table.columns.push_back({.name = metric.name,
                             .unit = metric.unit,
                             .best = metric.higher_is_better ? Best::highest : Best::lowest});
  table.group_by = 0;
  std::vector<const Measured*> rows;
  for (const Measured& row : comparison.rows) rows.push_back(&row);
  std::ranges::stable_sort(rows, {}, &Measured::spp);
  for (const Measured* row : rows) {
    std::vector<Cell> cells = {
        row->spp, row->estimator, {row->seconds.mean, row->seconds.standard_deviation}};
    for (const Spread& s : row->metrics) cells.emplace_back(s.mean, s.standard_deviation);
    table.rows.push_back(std::move(cells));
  }
  return table;
}

std::vector<std::string> estimators_of(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const Measured& row : comparison.rows)
    if (std::ranges::find(names, row.estimator) == names.end()) names.push_back(row.estimator);
  return names;
}

/// One metric of every estimator over samples or over seconds.
std::string convergence_plot(const Comparison& comparison, std::size_t metric, bool over_seconds) {
  const Metric& what = metric_list[metric];
  Plot plot;
  plot.title = fmt::format("{} over {}", what.name, over_seconds ? "time" : "samples");
  plot.x = over_seconds ? Axis{.label = "seconds", .scale = Scale::log}
                        : Axis{.label = "samples a pixel", .scale = Scale::log2};
  // Decibels are a logarithm already.
  plot.y = {.label = fmt::format("{} [{}]", what.name, what.unit),
            .scale = what.value == &Metrics::psnr ? Scale::linear : Scale::log};
  for (const std::string& name : estimators_of(comparison)) {
    Line line{.name = name};
    for (const Measured& row : comparison.rows) {
      if (row.estimator != name) continue;
      line.x.push_back(over_seconds ? row.seconds.mean : double(row.spp));
      line.y.push_back(row.metrics[metric].mean);
      line.error.push_back(std::isfinite(row.metrics[metric].standard_deviation)
                               ? row.metrics[metric].standard_deviation
                               : 0);
    }
    plot.marks.push_back(std::move(line));
  }
  return svg(plot);
}

/// Writes an image and gives the bytes of its file, for the page.
std::string written_png(const Image& image, const std::filesystem::path& path) {
  write_picture(path, picture_of(image));
  const auto bytes = read_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The count whose pictures are shown: the one closest to 4, where differences can be seen.
std::int64_t shown_spp(const Comparison& comparison, const std::string& estimator) {
  std::int64_t best = 0;
  double distance = INFINITY;
  for (const Measured& row : comparison.rows)
    if (row.estimator == estimator && std::abs(std::log2(double(row.spp)) - 2) < distance) {
      distance = std::abs(std::log2(double(row.spp)) - 2);
      best = row.spp;
    }
  return best;
}

}  // namespace

void write_comparison(const Comparison& comparison, const std::string& scene_name,
                      const std::filesystem::path& folder) {
  const std::filesystem::path pictures = folder / "pictures";
  make_folder(pictures);

  Page page("Estimators on " + scene_name,
            fmt::format("Compared with {}. Computed with {} instructions.",
                        comparison.reference_source, comparison.instruction_set));
  page.heading("How far each is from the reference");
  std::vector<Formula> formulas;
  for (const Metric& metric : metric_list) formulas.push_back({metric.name, metric.formula});
  formulas.push_back(
      {"seconds", "from the first ray to the last", "without loading and without writing"});
  page.paragraph(
      "a: a value of the picture, b: of the reference; means run over all pixels and channels, in "
      "linear light.");
  page.formulas(formulas);
  const Table table = table_of(comparison);
  page.table(table);

  if (const std::string warning = warning_of(comparison); !warning.empty())
    page.paragraph("Warning: " + warning + ".");

  if (comparison.rows.size() > estimators_of(comparison).size()) {  // not a point each
    page.heading("Convergence");
    constexpr std::size_t rmse = index_of(&Metrics::rmse), psnr = index_of(&Metrics::psnr);
    page.figure({convergence_plot(comparison, rmse, false),
                 "Error over samples. A slope of −1/2 is that of independent samples."});
    page.figure({convergence_plot(comparison, rmse, true), "Error over time."});
    page.figure({convergence_plot(comparison, psnr, false), "The same in decibels."});
  }

  page.heading("Pictures");
  std::vector<Figure> figures = {{written_png(comparison.reference, pictures / "reference.png"),
                                  "reference: " + comparison.reference_source}};
  for (const Measured& row : comparison.rows) {
    const std::string name = fmt::format("{}_{}", row.estimator, row.spp);
    const std::string png = written_png(row.picture, pictures / (name + ".png"));
    const float gain = 4;
    const std::string difference =
        written_png(difference_image(row.picture, comparison.reference, gain),
                    pictures / (name + "_difference.png"));
    if (row.spp != shown_spp(comparison, row.estimator)) continue;
    figures.push_back({png, fmt::format("{}, {} spp", row.estimator, row.spp)});
    figures.push_back(
        {difference, fmt::format("{}, {} spp: |difference| × {}", row.estimator, row.spp, gain)});
  }
  page.figures(figures, 3,
               "Pictures of the first seed, sRGB, and how far they are from the reference.");

  write_text(folder / "results.csv", csv(table));
  write_text(folder / "index.html", page.html(fmt::format("Airlight {}", version())));
}

}  // namespace airlight
