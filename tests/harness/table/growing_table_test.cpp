#include "harness/table/growing_table.h"

#include "core/base/error.h"
#include "tests/temporary_folder.h"

#include <csignal>
#include <limits>

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace hybray {
namespace {

const std::vector<Column> kColumns = {{"n", "", ColumnKind::key, Better::none, ""},
                                      {"x_m", "m", ColumnKind::metric, Better::lower, ""}};
const std::vector<std::string> kOrder = {"p1", "p2", "p3"};

std::string line(const std::string& id, int64_t n, double x) {
  return table_line(kColumns, id, {{"n", n}, {"x_m", x}});
}

TEST(GrowingTable, ShowsEachRowAtOnceInThePartialFile) {
  const test::TemporaryFolder folder;
  GrowingTable table(folder.path(), "t", table_header(kColumns));
  EXPECT_EQ(test::content_of(folder / "t.csv.partial"), "id,n,x_m\n");
  table.append("p2", line("p2", 2, 0.5));
  EXPECT_EQ(test::content_of(folder / "t.csv.partial"), "id,n,x_m\np2,2,0.5\n");
}

TEST(GrowingTable, GivesItsRowsInFrozenOrderWithoutThePointsThatHaveNone) {
  const test::TemporaryFolder folder;
  GrowingTable table(folder.path(), "t", table_header(kColumns));
  table.append("p3", line("p3", 3, 1.5));
  table.append("p1", table_line(kColumns, "p1", {{"n", int64_t{1}}}));
  EXPECT_EQ(table.content(kOrder), "id,n,x_m\np1,1,\np3,3,1.5\n");
  table.remove_partial();
  EXPECT_FALSE(std::filesystem::exists(folder / "t.csv.partial"));
}

TEST(GrowingTable, LeavesAnEarlierTableAlone) {
  const test::TemporaryFolder folder;
  folder.write("t.csv", "old\n");
  {
    GrowingTable table(folder.path(), "t", table_header(kColumns));
    table.append("p1", line("p1", 1, 1));
  }
  EXPECT_EQ(test::content_of(folder / "t.csv"), "old\n");
  EXPECT_EQ(test::content_of(folder / "t.csv.partial"), "id,n,x_m\np1,1,1\n");
}

TEST(GrowingTable, BeginsWithTheLinesOfEarlierSessionsInPlaceOfWhatWasThere) {
  const test::TemporaryFolder folder;
  folder.write("t.csv.partial", "id,n,x_m\np1,1,1\np2,2,0.");
  GrowingTable table(folder.path(), "t", table_header(kColumns), {{"p1", "p1,1,1\n"}});
  table.append("p3", line("p3", 3, 3));
  EXPECT_EQ(test::content_of(folder / "t.csv.partial"), "id,n,x_m\np1,1,1\np3,3,3\n");
  EXPECT_EQ(table.content(kOrder), "id,n,x_m\np1,1,1\np3,3,3\n");
}

TEST(GrowingTable, NeverWritesANumberThatIsNotFinite) {
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(test::message_of<RuntimeError>([&] { line("p1", 1, x); }),
              "column \"x_m\" came out as a number that is not finite");
  }
}

TEST(GrowingTable, TakesBackARowThatDoesNotFitAndKeepsTheOthers) {
  const test::TemporaryFolder folder;
  GrowingTable table(folder.path(), "t", table_header(kColumns));
  table.append("p1", line("p1", 1, 1));
  const std::string before = test::content_of(folder / "t.csv.partial");

  rlimit old = {};
  getrlimit(RLIMIT_FSIZE, &old);
  const rlimit limit{before.size() + 5, old.rlim_max};  // the next row takes more
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &limit);
  const std::string message =
      test::message_of<RuntimeError>([&] { table.append("p2", line("p2", 2, 0.123456789)); });
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);

  EXPECT_EQ(message,
            (folder / "t.csv.partial").string() + ": cannot be written: File too large; its 1 rows are kept");
  EXPECT_EQ(test::content_of(folder / "t.csv.partial"), before);
  table.append("p2", line("p2", 2, 0.5));
  EXPECT_EQ(test::content_of(folder / "t.csv.partial"), before + "p2,2,0.5\n");
}

TEST(GrowingTable, EstimatesItsSizeFromAbove) {
  std::string table = table_header(kColumns);
  for (int i = 0; i < 10; ++i) table += line("0123456789abcdef", 1000000 + i, -1.2345678901234567e-3);
  const size_t estimate = estimated_table_bytes(kColumns, 10);
  EXPECT_GE(estimate, table.size());
  EXPECT_LE(estimate, 2 * table.size());
}

TEST(GrowingTableDeathTest, TakesACellWithoutAColumnForAProgrammingError) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(table_line(kColumns, "p", {{"n", int64_t{1}}, {"y", 1.0}}), "1 vs 2");
}

}  // namespace
}  // namespace hybray
