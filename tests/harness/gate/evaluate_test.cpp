#include "harness/gate/evaluate.h"

#include "tests/harness/gate/gate_fixture.h"

namespace hybray {
namespace {

using Lines = std::vector<std::string>;
using enum GateStatus;

class EvaluateTest : public test::GateFixture {
 protected:
  // Three scenes; all numbers are exact in binary.
  GatedTable three() {
    return table(
        "1,a,7,0.5,0.25,-2,10,true,m,1.5,9,8\n2,b,7,0.75,0.5,2,20,true,m,0.5,9,8\n3,c,7,,nan,1,30,true,m,,9,"
        "8\n");
  }
  GateResult check(const std::string& json, const std::string& accepted) {
    return evaluate(gate(json), three(), baseline(accepted));
  }
  GateResult check(const std::string& json) { return evaluate(gate(json), three(), no_baseline()); }
};

constexpr const char* kAccepted = "scene,size,alpha,loss,drift\na,7,0.625,0.25,-4\nb,7,0.5,0.25,4\n";

TEST_F(EvaluateTest, HoldsEveryMatchingRowAgainstMinAndMax) {
  const GateResult passed = check(R"({"column": "drift", "min": -2, "max": 2})");
  EXPECT_EQ(passed.status, GateStatus::passed) << "a bound is part of what passes";
  EXPECT_EQ(passed.rows, 3u);
  EXPECT_EQ(passed.margin, "0");
  const GateResult failed = check(R"({"column": "drift", "min": -1, "max": 1.5})");
  EXPECT_EQ(failed.status, missed);
  EXPECT_EQ(failed.misses,
            (Lines{"scene=a: -2 is below the least -1 by 1", "scene=b: 2 is above the greatest 1.5 by 0.5"}));
  EXPECT_EQ(failed.margin, "-1") << "the widest miss";
  EXPECT_EQ(failed.row, "scene=a");
}

TEST_F(EvaluateTest, ReportsTheSmallestMarginWithItsRow) {
  const GateResult result =
      check(R"({"column": "alpha", "where": {"scene": ["a", "b"]}, "min": 0.25, "max": 0.875})");
  EXPECT_EQ(result.status, passed);
  EXPECT_EQ(result.rows, 2u);
  EXPECT_EQ(result.value, "0.75");
  EXPECT_EQ(result.limit, "<= 0.875");
  EXPECT_EQ(result.margin, "0.125");
  EXPECT_EQ(result.row, "scene=b");
}

TEST_F(EvaluateTest, MissesWhereThereIsNothingToLookAt) {
  EXPECT_EQ(check(R"({"column": "alpha", "where": {"scene": "x"}, "min": 0})").misses,
            Lines{"no row matches"});
  EXPECT_EQ(check(R"({"column": "alpha", "where": {"scene": "c"}, "min": 0})").misses,
            Lines{"scene=c: the cell is empty"});
  EXPECT_EQ(check(R"({"column": "loss", "where": {"scene": "c"}, "min": 0})").misses,
            Lines{"scene=c: nan is not a finite number"});
  EXPECT_EQ(check(R"({"column": "speedup", "min": 0})").misses, Lines{"scene=c: the cell is empty"});
  EXPECT_EQ(
      check(R"({"column": "alpha", "where": {"scene": "a"}, "baseline": {"worse_by_at_most": 1}})").misses,
      Lines{"baseline/t.csv is not there: nothing was accepted yet"});
  EXPECT_EQ(check(R"({"column": "drift", "where": {"scene": "c"}, "baseline": {"differs_by_at_most": 1}})",
                  kAccepted)
                .misses,
            Lines{"scene=c: the accepted table has no such row"});
  EXPECT_EQ(check(R"({"column": "items", "where": {"scene": "a"}, "baseline": {"differs_by_at_most": 1}})",
                  kAccepted)
                .misses,
            Lines{"scene=a: the accepted value is missing"});
}

TEST_F(EvaluateTest, FailsTheRunForWantOfDataEvenWhereAFailureIsExpected) {
  const std::string expected = R"(, "expected_failure": "known"})";
  for (const char* start :
       {R"({"column": "alpha", "where": {"scene": "x"}, "min": 0)",
        R"({"column": "alpha", "where": {"scene": "c"}, "min": 0)",
        R"({"column": "loss", "where": {"scene": "c"}, "min": 0)",
        R"({"column": "alpha", "where": {"scene": "a"}, "baseline": {"worse_by_at_most": 1})",
        R"({"column": "*", "baseline": "unchanged")"})
    EXPECT_EQ(check(start + expected).status, missed) << start;
}

TEST_F(EvaluateTest, ExcusesAnExpectedFailureAndReportsWhenItPasses) {
  const GateResult failed = check(R"({"column": "drift", "max": 1, "expected_failure": "known"})");
  EXPECT_EQ(failed.status, expected_failure);
  EXPECT_EQ(failed.misses.size(), 1u);
  EXPECT_EQ(check(R"({"column": "drift", "max": 2, "expected_failure": "known"})").status, unexpected_pass);
}

TEST_F(EvaluateTest, LetsAValueGetBetterAndWorseOnlySoFar) {
  // alpha (higher is better): a fell by 0.125, b rose by 0.25; loss (lower is better): a as it was, b rose by
  // 0.25.
  const std::string ab = R"(, "where": {"scene": ["a", "b"]}, "baseline": )";
  EXPECT_EQ(check(R"({"column": "alpha")" + ab + R"({"worse_by_at_most": 0.125}})", kAccepted).status,
            passed);
  const GateResult alpha =
      check(R"({"column": "alpha")" + ab + R"({"worse_by_at_most": 0.0625}})", kAccepted);
  EXPECT_EQ(alpha.misses, Lines{"scene=a: 0.5 is below the least 0.5625 by 0.0625, accepted 0.625"});
  EXPECT_EQ(check(R"({"column": "loss")" + ab + R"({"worse_by_at_most": 0.25}})", kAccepted).status, passed);
  EXPECT_EQ(check(R"({"column": "loss")" + ab + R"({"worse_by_at_most": 0.125}})", kAccepted).misses,
            Lines{"scene=b: 0.5 is above the greatest 0.375 by 0.125, accepted 0.25"});
  EXPECT_EQ(check(R"({"column": "loss")" + ab + R"({"worse_by_at_most": 0, "better": "higher"}})", kAccepted)
                .status,
            passed)
      << "the gate's own direction counts";
}

TEST_F(EvaluateTest, TakesAmountsAsSharesOfTheAcceptedMagnitude) {
  // drift: -4 -> -2 and 4 -> 2, both by half.
  const std::string ab = R"(, "where": {"scene": ["a", "b"]}, "baseline": )";
  EXPECT_EQ(
      check(R"({"column": "drift")" + ab + R"({"differs_by_at_most": 0.5, "relative": true}})", kAccepted)
          .status,
      passed);
  EXPECT_EQ(
      check(R"({"column": "drift")" + ab + R"({"differs_by_at_most": 0.25, "relative": true}})", kAccepted)
          .misses,
      (Lines{"scene=a: -2 is above the greatest -3 by 1, accepted -4",
             "scene=b: 2 is below the least 3 by 1, accepted 4"}));
}

TEST_F(EvaluateTest, ComparesWholeTablesByTheDeclaredTolerances) {
  const std::string ab = R"({"column": "*", "where": {"scene": ["a", "b"]}, "baseline": "unchanged"})";
  const std::string header = "scene,size,alpha,loss,drift,items,good\n";
  const GateResult good = check(ab, header + "a,7,0.5,0.25,-2,10,true\nb,7,0.625,0.5,2,20,true\n");
  EXPECT_EQ(good.misses, Lines{});
  EXPECT_EQ(good.value, "1 of 10 cells moved");
  EXPECT_EQ(good.margin, "50 % of tolerance");
  EXPECT_EQ(good.row, "scene=b alpha");
  EXPECT_EQ(check(ab, header + "a,7,0.5,0.25,-2,10,true\nb,7,0.25,0.5,2,20,true\n").misses,
            Lines{"scene=b: alpha was 0.25, is 0.75 (+0.5; tolerance 0.25)"});
  EXPECT_EQ(check(ab,
                  "scene,size,alpha,loss,drift,items,good,gone\na,7,0.5,0.25,-2,10,true,1\n"
                  "b,7,0.75,0.5,2,20,true,1\n")
                .misses,
            Lines{"gone is accepted, but the experiment has no such column"});
}

TEST_F(EvaluateTest, RefusesATableWithoutTheColumn) {
  const auto file = folder_.write("t.csv", "id,scene,size\n1,a,7\n");
  const GatedTable t = GatedTable::of_run(file, experiment_);
  EXPECT_EQ(
      problem_of([&] { evaluate(gate(R"({"column": "alpha", "min": 0})"), t, no_baseline()); }).substr(0, 40),
      "t.csv:1: the column \"alpha\" is missing: ");
}

}  // namespace
}  // namespace hybray
