#include "harness/sweep/row_origin.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(RowOrigin, IsTheSameForTheSameChoicesInOneProgram) {
  EXPECT_EQ(row_origin(true, 2), row_origin(true, 2));
  EXPECT_EQ(row_origin(true, 2).at("program").size(), 16u);
}

TEST(RowOrigin, NamesWhatDiffers) {
  const RowOrigin a = row_origin(true, 2);
  EXPECT_EQ(difference(a, a), "");
  EXPECT_EQ(difference(a, row_origin(true, 3)), "threads");
  EXPECT_EQ(difference(a, row_origin(false, 3)), "threads, timing");
  RowOrigin b = a;
  b["program"] = "x";
  b.erase("instruction_sets");
  EXPECT_EQ(difference(a, b), "instruction_sets, program");
  EXPECT_EQ(difference(b, a), "instruction_sets, program");
  b = a;
  b["cpu"] = "another";
  EXPECT_EQ(difference(a, b), "cpu") << "times of two processors do not stand in one table";
}

}  // namespace
}  // namespace hybray
