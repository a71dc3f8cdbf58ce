#include "harness/gate/gated_table.h"

#include "tests/harness/gate/gate_fixture.h"

namespace hybray {
namespace {

class GatedTableTest : public test::GateFixture {
 protected:
  std::string problem(const std::string& csv) {
    return problem_of([&] { GatedTable::of_run(folder_.write("t.csv", csv), experiment_); });
  }
};

TEST(FiniteNumber, IsAllOfTheText) {
  EXPECT_EQ(finite_number("1.5e-3"), 1.5e-3);
  EXPECT_EQ(finite_number("-7"), -7.0);
  for (const char* text : {"", "nan", "NaN", "inf", "-inf", "1e999", "1 ", " 1", "1,5", "0x10", "one", "+1"})
    EXPECT_EQ(finite_number(text), std::nullopt) << text;
}

TEST_F(GatedTableTest, FindsRowsByTheirKeysAndNamesThemByWhatDiffers) {
  const GatedTable t = table("1,a,7,,,,,,,,,\n2,b,7,,,,,,,,,\n");
  ASSERT_EQ(t.row_count(), 2u);
  EXPECT_EQ(t.find(t.identity(1)), 1u);
  EXPECT_EQ(t.find("c,7\n"), std::nullopt);
  EXPECT_EQ(t.label(1), "scene=b") << "the size is the same in all rows";
  EXPECT_EQ(table("1,a,7,,,,,,,,,\n").label(0), "line 2");
  EXPECT_EQ(t.cell(1, "scene"), "b");
  EXPECT_EQ(t.cell(1, "nothing"), "");
}

TEST_F(GatedTableTest, FiltersByTextAndByNumber) {
  const GatedTable t = table("1,a,7,,,,,true,,,,\n2,b,7.0,,,,,false,,,,\n3,c,8,,,,,,,,,\n");
  const auto rows = [&](const std::string& where) {
    return t.matching(gate("{\"column\": \"alpha\", \"min\": 0, \"where\": " + where + "}").where);
  };
  using Rows = std::vector<size_t>;
  EXPECT_EQ(rows("{}"), (Rows{0, 1, 2}));
  EXPECT_EQ(rows(R"({"scene": ["a", "c"]})"), (Rows{0, 2}));
  EXPECT_EQ(rows(R"({"size": 7})"), (Rows{0, 1})) << "however the number is written";
  EXPECT_EQ(rows(R"({"size": [7, 8.0], "scene": ["b", "c"]})"), (Rows{1, 2})) << "all filters hold";
  EXPECT_EQ(rows(R"({"good": true})"), Rows{0});
  EXPECT_EQ(rows(R"({"scene": "A"})"), Rows{});
}

TEST_F(GatedTableTest, RefusesDamagedTablesWithFileAndLine) {
  EXPECT_EQ(problem(""), "t.csv: the table is empty: not even a header is there");
  EXPECT_EQ(problem("id,scene\n1,a\n2\n"), "t.csv:3: found 1 cells; expected 2, as in the header");
  EXPECT_EQ(problem("id,scene\n1,\"a\n"), "t.csv:3:1: the quote opened in line 2 is never closed");
  EXPECT_EQ(problem("id,scene,id\n1,a,2\n"), "t.csv:1: the column \"id\" stands twice in the header");
  EXPECT_EQ(problem("id,scene,size\n1,\"a\nb\",1\n2,b,1\n1,c,1\n"),
            "t.csv:5: the id \"1\" stands twice; its first place is line 2");
  EXPECT_EQ(problem("id,scene,size\n1,a,1\n2,a,1\n"),
            "t.csv:3: all keys are those of line 2: which of the two rows is meant cannot be told");
  EXPECT_EQ(problem("scene,size\na,1\n"),
            "t.csv:1: the column \"id\" is missing: this is no table of the experiment "
            "\"made\" of this version of the program");
}

}  // namespace
}  // namespace hybray
