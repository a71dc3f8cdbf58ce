#include "harness/gate/compare.h"

#include "tests/harness/gate/gate_fixture.h"

namespace hybray {
namespace {

using Lines = std::vector<std::string>;

class CompareTest : public test::GateFixture {
 protected:
  Comparisons with(const std::string& rows, const std::string& accepted) {
    return compare(table(rows), *baseline(accepted).table, compared_columns(experiment_), {});
  }
};

TEST_F(CompareTest, TakesMetricsCountsAndMeasuredKeysButNoTimes) {
  Lines names;
  for (const Column* column : compared_columns(experiment_)) names.push_back(column->name);
  EXPECT_EQ(names, (Lines{"alpha", "loss", "drift", "items", "good"}));
}

TEST_F(CompareTest, LetsValuesMoveWithinTheDeclaredTolerance) {
  // alpha +-0.25; items +-(2 + 12.5 % of the larger).
  const Comparisons found =
      with("1,a,7,0.75,1,,114,true,fast,,,\n", "scene,size,alpha,loss,items,good\na,7,0.5,1,98,true\n");
  EXPECT_EQ(found.differences, Lines{});
  EXPECT_EQ(found.missing, Lines{});
  EXPECT_EQ(found.cells, 5u);
  EXPECT_EQ(found.moved, 2u);
  EXPECT_EQ(found.least_left, 0.0);
  EXPECT_EQ(found.tightest, "line 2 alpha");
}

TEST_F(CompareTest, ReportsWhatMovedFurther) {
  const Comparisons found = with("1,a,7,0.75,1.5,,128,false,fast,,,\n",
                                 "scene,size,alpha,loss,items,good\na,7,0.4375,1,108,true\n");
  EXPECT_EQ(found.differences,
            (Lines{"line 2: alpha was 0.4375, is 0.75 (+0.312; tolerance 0.25)",
                   "line 2: loss was 1, is 1.5 (+0.5; tolerance 0)",
                   "line 2: items was 108, is 128 (+20; tolerance 18)", "line 2: good was true, is false"}));
}

TEST_F(CompareTest, ReportsWhatOnlyOneSideHas) {
  const Comparisons found =
      with("1,a,7,,1,,,true,,,,\n2,b,7,0.5,,,,,,,,\n", "scene,size,alpha,good\na,7,0.5,true\nc,7,1,true\n");
  EXPECT_EQ(found.missing, (Lines{"scene=a: alpha was 0.5, is (empty)", "scene=a: loss was (empty), is 1",
                                  "scene=b: the accepted table has no such row",
                                  "scene=c: the row is accepted, but missing"}));
  EXPECT_EQ(found.differences, Lines{});
}

TEST_F(CompareTest, NeverTakesNanForANumber) {
  const Comparisons found = with("1,a,7,nan,,,,,,,,\n", "scene,size,alpha\na,7,nan\n");
  EXPECT_EQ(found.missing, Lines{"line 2: alpha was nan, is nan"});
}

TEST_F(CompareTest, LooksOnlyAtTheRowsThatAreAskedFor) {
  const Gate only_a = gate(R"({"column": "*", "baseline": "unchanged", "where": {"scene": "a"}})");
  const Comparisons found = compare(table("1,a,7,0.5,,,,,,,,\n2,b,7,0.5,,,,,,,,\n"),
                                    *baseline("scene,size,alpha\na,7,0.5\nb,7,9\nc,7,1\n").table,
                                    compared_columns(experiment_), only_a.where);
  EXPECT_EQ(found.differences, Lines{});
  EXPECT_EQ(found.missing, Lines{});
}

}  // namespace
}  // namespace hybray
