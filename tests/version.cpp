#include "render/version.h"

#include <gmock/gmock.h>

TEST(Version, has_three_numbers) {
  EXPECT_THAT(airlight::version(), ::testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
}
