// Words of a line, and a line without the blanks at its ends.
#include "host/core/words.h"

#include <gtest/gtest.h>

namespace edgescout {
namespace {

using Words = std::vector<std::string>;

TEST(Words, StandBetweenBlanksAndTabs) {
  EXPECT_EQ(words_of("  fx \t700  fy 701 "), (Words{"fx", "700", "fy", "701"}));
  EXPECT_EQ(words_of("1, 2,,3", " ,"), (Words{"1", "2", "3"}));
  EXPECT_EQ(words_of(" \t "), Words{});
  EXPECT_EQ(words_of(""), Words{});
}

TEST(Words, LinesLoseTheBlanksAtTheirEnds) {
  EXPECT_EQ(trimmed("\t camera matrix  "), "camera matrix");
  EXPECT_EQ(trimmed(" \t "), "");
  EXPECT_EQ(trimmed(""), "");
}

}  // namespace
}  // namespace edgescout
