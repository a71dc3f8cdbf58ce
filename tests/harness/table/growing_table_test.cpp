#include "harness/table/growing_table.h"

#include "core/base/error.h"
#include "tests/temporary_folder.h"

#include <limits>

#include <gtest/gtest.h>

namespace hybray {
namespace {

const std::vector<Column> kColumns = {{"n", "", ColumnKind::key, Better::none, ""},
                                      {"x_m", "m", ColumnKind::metric, Better::lower, ""}};
const std::vector<std::string> kOrder = {"p1", "p2", "p3"};

Row row(int64_t n, double x) {
  return {{"n", n}, {"x_m", x}};
}

TEST(GrowingTable, ShowsEachRowAtOnceInThePartialFile) {
  const test::TemporaryFolder folder;
  GrowingTable table(folder.path(), "t", kColumns);
  EXPECT_EQ(test::content_of(folder / "t.csv.partial"), "id,n,x_m\n");
  table.append("p2", row(2, 0.5));
  EXPECT_EQ(test::content_of(folder / "t.csv.partial"), "id,n,x_m\np2,2,0.5\n");
}

TEST(GrowingTable, EndsInFrozenOrderWithoutThePointsThatHaveNoRow) {
  const test::TemporaryFolder folder;
  GrowingTable table(folder.path(), "t", kColumns);
  table.append("p3", row(3, 1.5));
  table.append("p1", {{"n", int64_t{1}}});
  table.finish(kOrder);
  EXPECT_EQ(test::content_of(folder / "t.csv"), "id,n,x_m\np1,1,\np3,3,1.5\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "t.csv.partial"));
}

TEST(GrowingTable, LeavesAnEarlierTableAloneUntilItIsComplete) {
  const test::TemporaryFolder folder;
  folder.write("t.csv", "old\n");
  {
    GrowingTable table(folder.path(), "t", kColumns);
    table.append("p1", row(1, 1));
    EXPECT_EQ(test::content_of(folder / "t.csv"), "old\n");
  }
  EXPECT_EQ(test::content_of(folder / "t.csv"), "old\n");
  EXPECT_EQ(test::content_of(folder / "t.csv.partial"), "id,n,x_m\np1,1,1\n");
}

TEST(GrowingTable, NeverWritesANumberThatIsNotFinite) {
  const test::TemporaryFolder folder;
  GrowingTable table(folder.path(), "t", kColumns);
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(test::message_of<RuntimeError>([&] { table.append("p1", row(1, x)); }),
              "column \"x_m\" came out as a number that is not finite");
  }
  EXPECT_EQ(test::content_of(folder / "t.csv.partial"), "id,n,x_m\n");
}

TEST(GrowingTable, RefusesASecondWriterWithoutHarmToTheFirst) {
  const test::TemporaryFolder folder;
  GrowingTable first(folder.path(), "t", kColumns);
  first.append("p1", row(1, 1));
  const std::string message =
      test::message_of<InputError>([&] { GrowingTable(folder.path(), "t", kColumns); });
  EXPECT_EQ(message,
            (folder / "t.csv.partial").string() + ": cannot be written: another run is writing to it");
  EXPECT_EQ(test::content_of(folder / "t.csv.partial"), "id,n,x_m\np1,1,1\n");
}

TEST(GrowingTableDeathTest, TakesACellWithoutAColumnForAProgrammingError) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(row_cells(kColumns, {{"n", int64_t{1}}, {"y", 1.0}}), "1 vs 2");
}

}  // namespace
}  // namespace hybray
