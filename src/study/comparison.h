#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "image/image.h"
#include "image/metrics.h"
#include "report/statistics.h"
#include "scene/scene.h"

namespace airlight {

/// The largest count that estimators are compared at.
inline constexpr std::int64_t most_compared_spp = 1 << 24;

/// What to compare on a scene and with what.
struct ComparisonSettings {
  std::vector<std::string> estimators;  ///< short names or placement+form
  std::vector<std::int64_t> spp;        ///< sample counts up to `most_compared_spp`, ascending
  int seeds = 4;                        ///< independent runs of each, from the scene's seed on
  double equal_time = 0;  ///< seconds for each estimator instead of `spp`; 0: off  [s]
  std::filesystem::path reference_file = {};  ///< a picture to compare with; empty: computed
  std::int64_t reference_spp =
      0;  ///< of a computed reference; 0: the closed form if there is one, else 16384
};

/// One estimator at one number of samples, over all seeds.
struct Measured {
  std::string estimator;
  std::int64_t spp = 0;
  Spread seconds;                                  ///< without loading  [s]
  std::array<Spread, metric_list.size()> metrics;  ///< in the order of `metric_list`
  std::vector<Metrics> of_seeds;                   ///< of each seed, from the first on
  Image picture;                                   ///< of the first seed

  const Spread& of(double Metrics::*metric) const { return metrics[index_of(metric)]; }
};

/// How far one is above the other, each seed's picture against the other's of that seed: what both
/// draw alike cancels. Throws Error if one has more seeds.
Spread difference(const Measured& one, const Measured& other, double Metrics::*metric);

struct Comparison {
  Image reference;
  std::string reference_source;  ///< in words
  double reference_error = 0;    ///< its own RMSE, as far as it is known  [W/(m2 sr)]
  std::vector<Measured> rows;    ///< by estimator, then by spp
  const char* instruction_set = "";

  /// The row of an estimator at a count, which must be there.
  const Measured& of(const std::string& estimator, std::int64_t spp) const;
};

/// The rows that the reference cannot judge, since its own error is more than half of theirs; empty
/// if there are none.
std::string warning_of(const Comparison& comparison);

/// Throws Error where an estimator is not known or can't serve the scene, or the picture to compare
/// with does not fit; traces no ray. Gives back that picture; an empty one if none is named.
Image check_comparison(const Scene& scene, const ComparisonSettings& settings);

/// Renders every estimator at every count with every seed and measures its distance to the
/// reference, which is what `check_comparison` gave back, or computed if that is empty.
Comparison compare_estimators(const Scene& scene, const ComparisonSettings& settings,
                              Image reference);

/// The same, checked first.
Comparison compare_estimators(const Scene& scene, const ComparisonSettings& settings);

/// Writes index.html, results.csv and the pictures into a folder, which is made if it is missing.
void write_comparison(const Comparison& comparison, const std::string& scene_name,
                      const std::filesystem::path& folder);

}  // namespace airlight
