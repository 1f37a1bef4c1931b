// The points of a pixel: strata however a render was cut, independent wherever they should be.

#include "airlight/math/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "report/statistics.h"
#include "support/worst.h"

namespace airlight {
namespace {

using std::uint32_t;

Sampler<double> sampler(uint32_t seed, uint32_t x, uint32_t y) { return {pixel_hash(seed, x, y)}; }

constexpr uint32_t streams[] = {0, 1, 2, 3, 7, 100, 0x10000, 0xffffffff};

/// p of numbers in [0, 1) being uniform.
double uniform_p(const std::vector<double>& numbers, int bins) {
  const Histogram h = histogram(numbers, bins, 0, 1);
  EXPECT_EQ(h.outside, 0);
  return chi_squared(h.counts,
                     std::vector<double>(std::size_t(bins), double(numbers.size()) / bins))
      .p;
}

/// p of pairs of numbers in [0, 1) being uniform in the square: neither depends on the other.
double independent_p(const std::vector<double>& a, const std::vector<double>& b, int bins = 16) {
  std::vector<double> cells;
  for (std::size_t i = 0; i < a.size(); ++i)
    cells.push_back((std::floor(a[i] * bins) + std::min(b[i], 1 - 1e-9)) / bins);
  return uniform_p(cells, bins * bins);
}

/// f of every pixel of an image.
std::vector<double> over_pixels(const std::function<double(const Sampler<double>&)>& f,
                                uint32_t seed = 0, uint32_t x0 = 0, uint32_t y0 = 0,
                                uint32_t size = 256) {
  std::vector<double> result;
  for (uint32_t y = 0; y < size; ++y)
    for (uint32_t x = 0; x < size; ++x) result.push_back(f(sampler(seed, x0 + x, y0 + y)));
  return result;
}

// A p-value below this in one of some hundred tests would be chance in one choice of
// seeds out of a few dozen; the seeds are fixed.
constexpr double least_p = 1e-4;

// ------------------------------------------------------------------------------------------------

TEST(One, has_a_point_in_each_stratum_of_every_aligned_block) {
  for (const uint32_t stream : streams) {
    const Sampler<double> s = sampler(1, 17 * stream, 5);
    for (int k = 0; k <= 10; ++k) {
      const uint32_t n = 1u << k;
      for (const uint32_t first : {0u, 1u << 20, 0x12345u << 12, 0xfffff000u})
        for (uint32_t start = first, block = 0; block < 4096 / n; start += n, ++block) {
          std::vector<int> hits(n);
          for (uint32_t i = 0; i < n; ++i) ++hits[std::size_t(s.one(start + i, stream) * n)];
          ASSERT_EQ(hits, std::vector<int>(n, 1))
              << n << " from " << start << ", stream " << stream;
        }
    }
  }
}

TEST(One, is_uniform_over_pixels_streams_seeds_and_indices) {
  for (const uint32_t index : {0u, 1u, 5u, 1000u, 0x80000000u})
    for (const uint32_t stream : streams)
      EXPECT_GT(uniform_p(over_pixels([&](const auto& s) { return s.one(index, stream); }), 1024),
                least_p)
          << index << " " << stream;
  std::vector<double> over_streams, over_seeds;
  for (uint32_t i = 0; i < 65536; ++i) {
    over_streams.push_back(sampler(3, 10, 20).one(7, i));
    over_seeds.push_back(sampler(i, 10, 20).one(7, 2));
  }
  EXPECT_GT(uniform_p(over_streams, 1024), least_p);
  EXPECT_GT(uniform_p(over_seeds, 1024), least_p);
}

TEST(One, is_jittered_inside_its_strata) {
  const auto jitter = [](double u, double n) { return u * n - std::floor(u * n); };
  for (const uint32_t n : {2u, 4u, 16u, 64u})
    for (uint32_t index = 0; index < 4; ++index)
      EXPECT_GT(
          uniform_p(over_pixels([&](const auto& s) { return jitter(s.one(index, 4), n); }), 256),
          least_p)
          << index << " of " << n;
  // The jitter neither follows the stratum nor that of another point of the block.
  const auto at = [&](uint32_t index) {
    return over_pixels([=](const auto& s) { return s.one(index, 4); });
  };
  std::vector<double> stratum = at(0), inside = at(0), other = at(1), far = at(3);
  for (double& u : inside) u = jitter(u, 4);
  for (double& u : other) u = jitter(u, 4);
  for (double& u : far) u = jitter(u, 4);
  for (double& u : stratum) u = std::floor(u * 4) / 4 + 0.125;
  std::vector<double> cells;
  for (std::size_t i = 0; i < stratum.size(); ++i)
    cells.push_back(stratum[i] + inside[i] / 4 - 0.125);
  EXPECT_GT(uniform_p(cells, 256), least_p);
  EXPECT_GT(independent_p(inside, other), least_p);
  EXPECT_GT(independent_p(inside, far), least_p);
}

TEST(One, averages_as_well_as_jittered_strata) {
  // Of a block of n, the mean of f(u) = u has the variance 1 / (12 n^3) if each point is uniform in
  // its stratum and knows nothing of the others.
  for (const uint32_t n : {1u, 2u, 4u, 8u, 16u, 64u}) {
    const std::vector<double> means = over_pixels([&](const auto& s) {
      double sum = 0;
      for (uint32_t i = 0; i < n; ++i) sum += s.one(i, 0);
      return sum / n;
    });
    const double expected = 1 / (12. * n * n * n), found = std::pow(standard_deviation(means), 2);
    // The variance of a variance over m pixels is at most 2 / m of its square.
    EXPECT_NEAR(found / expected, 1, 4 * std::sqrt(2. / double(means.size()))) << n;
    EXPECT_NEAR(mean(means), 0.5, 4 * standard_error(means)) << n;
  }
}

TEST(One, knows_nothing_of_other_streams) {
  for (const uint32_t index : {0u, 1u, 6u}) {
    std::vector<std::vector<double>> drawn;
    for (const uint32_t stream : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u, 256u})
      drawn.push_back(over_pixels([&](const auto& s) { return s.one(index, stream); }));
    for (std::size_t a = 0; a < drawn.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        EXPECT_GT(independent_p(drawn[a], drawn[b]), least_p) << index << ": " << a << ", " << b;
  }
}

TEST(One, knows_nothing_of_other_pixels_and_seeds) {
  const auto at = [](uint32_t seed, uint32_t x, uint32_t y) {
    return over_pixels([](const auto& s) { return s.one(2, 1); }, seed, x, y);
  };
  const std::vector<double> here = at(9, 0, 0);
  EXPECT_GT(independent_p(here, at(9, 1, 0)), least_p);
  EXPECT_GT(independent_p(here, at(9, 0, 1)), least_p);
  EXPECT_GT(independent_p(here, at(9, 16, 0)), least_p);
  EXPECT_GT(independent_p(here, at(9, 256, 256)), least_p);
  EXPECT_GT(independent_p(here, at(10, 0, 0)), least_p);
  EXPECT_GT(independent_p(here, at(8, 0, 0)), least_p);
  EXPECT_GT(independent_p(here, at(9 + (1u << 31), 0, 0)), least_p);
}

TEST(PointsOfPaths, fill_the_square_within_one_pixel) {
  // The paths of a pixel must try every combination of what happens at two of their vertices, or
  // of two things at one. Chi-squared over degrees of freedom is about 1 for independent points;
  // the hash that shuffles is good to 1.6, points that move together give 240.
  constexpr uint32_t paths = 4096, bins = 16;
  double worst = 0;
  for (uint32_t x = 0; x < 64; ++x) {
    const auto judge = [&](uint32_t vertex, uint32_t stream, uint32_t other_vertex,
                           uint32_t other_stream) {
      std::vector<double> cells(bins * bins);
      for (uint32_t path = 0; path < paths; ++path) {
        const auto bin = [&](uint32_t v, uint32_t id) {
          return uint32_t(PathSampler<double>{pixel_hash(6, x, 9), path, v}.one(0, id) * bins);
        };
        ++cells[bin(vertex, stream) * bins + bin(other_vertex, other_stream)];
      }
      const std::vector<double> expected(cells.size(), double(paths) / (bins * bins));
      const ChiSquared found = chi_squared(cells, expected);
      worst = std::max(worst, found.statistic / found.degrees);
    };
    judge(0, 3, 1, 3);
    judge(1, 3, 7, 3);
    judge(0, 3, 0, 4);
    judge(2, 3, 5, 4);
  }
  std::printf("[ measured ] worst chi-squared over degrees of freedom: %.2f\n", worst);
  EXPECT_LT(worst, 3);
}

TEST(One, pairs_strata_of_two_streams_at_random) {
  // Within a block of 4, which stratum of one stream meets which of another: all 16 alike.
  for (uint32_t index = 0; index < 4; ++index)
    EXPECT_GT(independent_p(over_pixels([&](const auto& s) { return s.one(index, 1); }),
                            over_pixels([&](const auto& s) { return s.one(index, 5); }), 4),
              least_p);
}

TEST(Two, has_a_point_in_each_elementary_interval_of_every_aligned_block) {
  for (const uint32_t stream : {0u, 1u, 9u}) {
    const Sampler<double> s = sampler(4, 3, 1000 * stream);
    for (int k = 0; k <= 10; ++k) {
      const uint32_t n = 1u << k;
      for (const uint32_t first : {0u, 0x7ffff000u})
        for (uint32_t start = first, block = 0; block < std::max(2048 / n, 1u);
             start += n, ++block) {
          std::vector<Vec2<double>> points;
          for (uint32_t i = 0; i < n; ++i) points.push_back(s.two(start + i, stream));
          for (int a = 0; a <= k; ++a) {
            const uint32_t columns = 1u << a, rows = 1u << (k - a);
            std::vector<int> hits(n);
            for (const auto [x, y] : points)
              ++hits[std::size_t(x * columns) * rows + std::size_t(y * rows)];
            ASSERT_EQ(hits, std::vector<int>(n, 1))
                << n << " from " << start << " in " << columns << " x " << rows;
          }
        }
    }
  }
}

TEST(Halves, of_every_aligned_block_are_stratified) {
  for (const uint32_t stream : {0u, 1u, 8u, 11u}) {
    const Sampler<double> s = sampler(5, 3, 1000 * stream);
    for (int k = 1; k <= 10; ++k) {
      const uint32_t n = 1u << k;
      for (const uint32_t start : {0u, 5 * n, 0x7ffff000u}) {
        for (int half = 0; half < 2; ++half) {
          std::vector<double> line;
          std::vector<Vec2<double>> square;
          for (uint32_t i = start; i < start + n; ++i) {
            if (half_of(i) != half) continue;
            line.push_back(s.one(i, stream)), square.push_back(s.two(i, stream));
          }
          ASSERT_EQ(line.size(), n / 2);
          std::vector<int> hits(n / 2);
          for (const double x : line) ++hits[std::size_t(x * n / 2)];
          ASSERT_EQ(hits, std::vector<int>(n / 2, 1)) << n << " from " << start;
          for (int a = 0; a <= k - 2; ++a) {  // elementary intervals with two points each
            const uint32_t columns = 1u << a, rows = 1u << (k - 2 - a);
            std::vector<int> pairs(n / 4);
            for (const auto [x, y] : square)
              ++pairs[std::size_t(x * columns) * rows + std::size_t(y * rows)];
            ASSERT_EQ(pairs, std::vector<int>(n / 4, 2))
                << n << " from " << start << " in " << columns << " x " << rows;
          }
        }
      }
    }
  }
}

TEST(Two, is_uniform_in_the_square_over_pixels) {
  for (const uint32_t index : {0u, 1u, 6u, 77u})
    for (const uint32_t stream : {0u, 1u, 8u})
      EXPECT_GT(
          independent_p(over_pixels([&](const auto& s) { return s.two(index, stream).x; }),
                        over_pixels([&](const auto& s) { return s.two(index, stream).y; }), 32),
          least_p)
          << index << " " << stream;
}

TEST(Two, knows_nothing_of_other_streams_and_points) {
  const auto x = [](uint32_t index, uint32_t stream) {
    return over_pixels([=](const auto& s) { return s.two(index, stream).x; });
  };
  const auto y = [](uint32_t index, uint32_t stream) {
    return over_pixels([=](const auto& s) { return s.two(index, stream).y; });
  };
  const auto one = [](uint32_t index, uint32_t stream) {
    return over_pixels([=](const auto& s) { return s.one(index, stream); });
  };
  for (const uint32_t index : {0u, 3u}) {
    EXPECT_GT(independent_p(x(index, 1), x(index, 2)), least_p) << index;
    EXPECT_GT(independent_p(x(index, 1), y(index, 2)), least_p) << index;
    EXPECT_GT(independent_p(y(index, 1), y(index, 2)), least_p) << index;
    EXPECT_GT(independent_p(x(index, 1), one(index, 0)), least_p) << index;
    EXPECT_GT(independent_p(y(index, 1), one(index, 0)), least_p) << index;
  }
}

TEST(Sampler, says_the_same_in_every_arithmetic) {
  for (uint32_t x = 0; x < 64; x += uint32_t(lanes<FloatBatch>)) {
    alignas(64) uint32_t hashes[lanes<FloatBatch>];
    for (int k = 0; k < lanes<FloatBatch>; ++k) hashes[k] = pixel_hash(11, x + uint32_t(k), 4);
    const Sampler<FloatBatch> packet{UInt<FloatBatch>::load_aligned(hashes)};
    for (const uint32_t index : {0u, 1u, 2u, 1023u, 0xffffffffu})
      for (const uint32_t stream : streams) {
        const FloatBatch one = packet.one(index, stream);
        const Vec2<FloatBatch> two = packet.two(index, stream);
        for (int k = 0; k < lanes<FloatBatch>; ++k) {
          const Sampler<double> in_double{hashes[k]};
          const Sampler<float> in_float{hashes[k]};
          EXPECT_EQ(in_float.one(index, stream), in_double.one(index, stream));
          EXPECT_EQ(lane(one, k), in_double.one(index, stream));
          EXPECT_EQ(in_float.two(index, stream).x, in_double.two(index, stream).x);
          EXPECT_EQ(in_float.two(index, stream).y, in_double.two(index, stream).y);
          EXPECT_EQ(lane(two.x, k), in_double.two(index, stream).x);
          EXPECT_EQ(lane(two.y, k), in_double.two(index, stream).y);
        }
      }
  }
}

TEST(UnitInterval, stays_below_one) {
  EXPECT_EQ(unit_interval<double>(0u), 0);
  EXPECT_EQ(unit_interval<double>(0xffffffffu), 1 - 0x1p-24);
  EXPECT_EQ(unit_interval<float>(0xffffffffu), 1 - 0x1p-24f);
  EXPECT_EQ(lane(unit_interval<FloatBatch>(UInt<FloatBatch>(0xffffffffu)), 0), 1 - 0x1p-24f);
}

TEST(ReverseBits, turns_a_number_round) {
  EXPECT_EQ(reverse_bits(1u), 0x80000000u);
  EXPECT_EQ(reverse_bits(0x12345678u), 0x1e6a2c48u);
  for (uint32_t x : {0u, 7u, 0xdeadbeefu}) EXPECT_EQ(reverse_bits(reverse_bits(x)), x);
}

TEST(SobolSecond, follows_its_direction_numbers) {
  // Sobol's second dimension, primitive polynomial x + 1: 0, 1/2, 3/4, 1/4, 5/8, 1/8, 3/8, 7/8.
  const uint32_t eighths[] = {0, 4, 6, 2, 5, 1, 3, 7};
  for (uint32_t i = 0; i < 8; ++i)
    EXPECT_EQ(reverse_bits(reversed_sobol_second(i)) >> 29, eighths[i]) << i;
}

}  // namespace
}  // namespace airlight
