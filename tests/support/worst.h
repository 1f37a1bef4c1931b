#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>

namespace airlight::test {

/// The largest of many errors and where it occurred, held to a bound and told at the end: what a
/// docstring may claim is what this prints.
class Worst {
 public:
  explicit Worst(std::string what) : what_(std::move(what)) {}

  /// NaN is worse than everything.
  template <class Where>
  void see(double error, const Where& where) {
    ++count_;
    if (!(error > largest_) && !std::isnan(error)) return;
    if (std::isnan(largest_)) return;
    largest_ = error;
    std::ostringstream text;
    text.precision(17);
    text << where;
    where_ = text.str();
  }

  double largest() const { return largest_; }

  void expect_below(double bound) const {
    EXPECT_GT(count_, 0) << what_;
    EXPECT_LE(largest_, bound) << what_ << ", worst at " << where_;
    std::printf("[ measured ] %s: %.3g in %ld cases, allowed %.3g\n", what_.c_str(), largest_,
                count_, bound);
  }

 private:
  std::string what_, where_ = "nothing";
  double largest_ = 0;
  long count_ = 0;
};

}  // namespace airlight::test
