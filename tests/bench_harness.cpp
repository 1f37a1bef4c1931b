#include <gmock/gmock.h>

#include <sched.h>

#include <chrono>
#include <cmath>

#include <string>
#include <thread>

#include "measure.h"
#include "table.h"

using namespace airlight::bench;

TEST(Must, holds_on_the_right_side_of_its_bound) {
  EXPECT_TRUE(Must::at_least(7).holds(7));
  EXPECT_FALSE(Must::at_least(7).holds(6.99));
  EXPECT_TRUE(Must::at_most(0.85).holds(0.85));
  EXPECT_FALSE(Must::at_most(0.85).holds(0.86));
  EXPECT_TRUE(Must{}.holds(-1e30));
}

TEST(Must, is_never_kept_by_what_is_no_number) {
  for (const Must must : {Must{}, Must::at_least(0), Must::at_most(0)})
    EXPECT_FALSE(must.holds(std::nan("")));
}

TEST(Must, reads_like_a_bound) {
  EXPECT_EQ(Must::at_least(7).text(), ">= 7");
  EXPECT_EQ(Must::at_most(0.85).text(), "<= 0.85");
  EXPECT_EQ(Must{}.text(), "");
}

TEST(Median, is_the_middle) {
  EXPECT_EQ(median({5, 1, 9}), 5);
  EXPECT_EQ(median({4, 1, 9, 2}), 3);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(SecondsTo, lies_between_the_runs_on_either_side) {
  const std::vector<double> quality{10, 20, 30}, seconds{1, 4, 16};
  EXPECT_NEAR(seconds_to(10, quality, seconds), 1, 1e-12);
  EXPECT_NEAR(seconds_to(15, quality, seconds), 2, 1e-12);
  EXPECT_NEAR(seconds_to(25, quality, seconds), 8, 1e-12);
  EXPECT_NEAR(seconds_to(30, quality, seconds), 16, 1e-12);
  for (const double beyond : {9., 31.})
    EXPECT_TRUE(std::isnan(seconds_to(beyond, quality, seconds)));
  EXPECT_TRUE(std::isnan(seconds_to(1, {}, {})));
}

TEST(MedianRatio, runs_both_sides_equally_often_and_in_turn) {
  std::string order;
  median_ratio(
      3, [&] { order += 'a'; }, [&] { order += 'b'; });
  EXPECT_EQ(order,
            "ab"
            "ab"
            "ba"
            "ab");
}

TEST(MedianRatio, tells_slow_from_fast) {
  // Sleeps last at least as long as asked for; on a loaded machine both grow, the longer one more
  // rarely to the half.
  const auto sleep = [](int ms) {
    return [ms] { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); };
  };
  EXPECT_GT(median_ratio(5, sleep(20), sleep(2)), 2);
}

TEST(Pin, lets_go_when_it_ends) {
  const auto processors = [] {
    cpu_set_t set;
    sched_getaffinity(0, sizeof set, &set);
    return CPU_COUNT(&set);
  };
  const int before = processors();
  {
    const Pin pin(1);
    EXPECT_EQ(processors(), pin.pinned() ? 1 : before);
  }
  EXPECT_EQ(processors(), before);
}

TEST(Table, names_what_was_measured_and_whether_it_holds) {
  const std::string text = table({{"box.avx2", 5.25, "ns a ray", Must::at_most(16), "avx2"},
                                  {"box.gain", 3, "x", Must::at_least(4), "avx2"},
                                  {"startup", 0.02, "s", {}, ""}});
  EXPECT_EQ(text,
            "row      | measured      | must reach | holds | instruction set\n"
            "box.avx2 | 5.25 ns a ray | <= 16      | yes   | avx2\n"
            "box.gain | 3 x           | >= 4       | NO    | avx2\n"
            "startup  | 0.02 s        |            |       |\n");
}

TEST(Table, of_nothing_is_its_heading) {
  EXPECT_EQ(table({}), "row | measured | must reach | holds | instruction set\n");
}

TEST(Json, has_five_members_a_row) {
  EXPECT_EQ(to_json({{"a", 2, "x", Must::at_least(1.5), "avx2"}, {"b", std::nan(""), "s", {}, ""}}),
            R"([
  {
    "name": "a",
    "value": 2.0,
    "unit": "x",
    "must": ">= 1.5",
    "holds": true
  },
  {
    "name": "b",
    "value": null,
    "unit": "s",
    "must": null,
    "holds": false
  }
]
)");
  EXPECT_EQ(to_json({}), "[]\n");
}
