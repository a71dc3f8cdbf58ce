#include "harness/table/csv.h"

#include "core/base/error.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

using Cells = std::vector<std::string>;

std::string problem(const std::string& text) {
  return test::message_of<InputError>([&] { parse_csv(text, "t.csv"); });
}

TEST(Csv, QuotesOnlyCellsThatNeedIt) {
  EXPECT_EQ(csv_line(Cells{"a", "", "b c", "1.5"}), "a,,b c,1.5\n");
  EXPECT_EQ(csv_line(Cells{"a,b", "say \"no\"", "two\nlines", "cr\r"}),
            "\"a,b\",\"say \"\"no\"\"\",\"two\nlines\",\"cr\r\"\n");
}

TEST(Csv, ReadsTheExamplesOfRfc4180) {
  const CsvTable table = parse_csv("field_name,\"b\"\"b\"\r\n\"aaa\",\"b\r\nb\"\r\nzzz,\r\n", "t.csv");
  EXPECT_EQ(table.header, (Cells{"field_name", "b\"b"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0], (Cells{"aaa", "b\r\nb"}));
  EXPECT_EQ(table.rows[1], (Cells{"zzz", ""}));
  EXPECT_EQ(table.column("b\"b"), 1);
  EXPECT_EQ(table.column("c"), -1);
}

TEST(Csv, ReadsATableWithoutALastLineEnd) {
  EXPECT_EQ(parse_csv("a,b\n1,2", "t.csv").rows, (std::vector<Cells>{{"1", "2"}}));
}

TEST(Csv, ReadsTheWholeRowsOfATornText) {
  const std::string text =
      csv_line(Cells{"a", "b"}) + csv_line(Cells{"1", "x\ny"}) + csv_line(Cells{"2", "\"\n"});
  const size_t first = 4 + 8;  // bytes up to the end of the first row
  for (size_t length = 0; length <= text.size(); ++length) {
    const CsvTable table = parse_whole_rows(text.substr(0, length));
    EXPECT_EQ(table.header, length < 4 ? Cells{} : (Cells{"a", "b"})) << length;
    EXPECT_EQ(table.rows.size(), length < first ? 0u : length < text.size() ? 1u : 2u) << length;
  }
}

TEST(Csv, ReadsNoRowBeyondOneThatIsDamaged) {
  const auto rows = [](const std::string& text) { return parse_whole_rows("a,b\n1,2\n" + text).rows.size(); };
  EXPECT_EQ(rows("3,4\n"), 2u);
  EXPECT_EQ(rows("3\n5,6\n"), 1u);
  EXPECT_EQ(rows("3,\"4\"x\n5,6\n"), 1u);
  EXPECT_EQ(rows(std::string(4096, '\0') + "\n5,6\n"), 1u) << "as a loss of power may leave it";
}

TEST(Csv, ReadsBackWhatItWrites) {
  const Cells cells{"", "\"", "\"\"", ",", "\n", "\r\n", "plain", "a\"b,c\nd"};
  EXPECT_EQ(parse_csv(csv_line(cells) + csv_line(cells), "t.csv").rows, std::vector<Cells>{cells});
}

TEST(Csv, NamesThePlaceOfWhatIsWrong) {
  EXPECT_EQ(problem(""), "t.csv: the table is empty: not even a header is there");
  EXPECT_EQ(problem("a,b\n1\n"), "t.csv:2: found 1 cells; expected 2, as in the header");
  EXPECT_EQ(problem("a,b\n1,\"2\n"), "t.csv:3:1: the quote opened in line 2 is never closed");
  EXPECT_EQ(problem("a,b\n\"1\"x,2\n"), "t.csv:2:4: expected a comma or the end of the line here");
  EXPECT_EQ(problem("a,b\nx\"1\",2\n"), "t.csv:2:2: expected a comma or the end of the line here");
}

}  // namespace
}  // namespace hybray
