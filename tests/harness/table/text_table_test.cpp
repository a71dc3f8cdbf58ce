#include "harness/table/text_table.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(TextTable, AlignsColumnsByCharactersAndEndsNoLineInSpaces) {
  EXPECT_EQ(aligned_table({{"a", "bb", "c"}, {"µµµ", "", "long"}, {"x", "y", ""}}),
            "a    bb  c\n"
            "µµµ      long\n"
            "x    y\n");
}

TEST(TextTable, OfNoRowsIsEmpty) {
  EXPECT_EQ(aligned_table({}), "");
  EXPECT_EQ(aligned_table({{"", ""}}), "\n");
}

}  // namespace
}  // namespace hybray
