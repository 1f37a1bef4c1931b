#pragma once
#include <gmock/gmock.h>

#include <algorithm>

#include "program.h"

namespace airlight::test {

/// The program did not do what it was asked for and says why: not a line more and not a word on
/// stdout, for a script and for a reader.
inline void expect_refused(const Outcome& outcome, const std::string& part) {
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_THAT(outcome.err, testing::HasSubstr(part));
  EXPECT_THAT(outcome.err, testing::EndsWith("\n"));
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

}  // namespace airlight::test
