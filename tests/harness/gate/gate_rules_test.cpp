#include "harness/gate/gate_rules.h"

#include "tests/harness/gate/gate_fixture.h"

namespace hybray {
namespace {

class GateRulesTest : public test::GateFixture {
 protected:
  std::string problem(const std::string& json) {
    return problem_of([&] { gates("[" + json + "]"); });
  }
};

TEST_F(GateRulesTest, ReadsEveryPart) {
  const Gate g =
      gate(R"({"name": "N", "column": "alpha", "where": {"scene": ["a", "b"], "size": 3}, "min": 0.5,
    "max": 1, "baseline": {"worse_by_at_most": 0.1, "relative": true}, "reason": "R", "expected_failure": "E"})");
  EXPECT_EQ(g.name, "N");
  EXPECT_EQ(g.column->name, "alpha");
  ASSERT_EQ(g.where.size(), 2u);
  EXPECT_EQ(g.where[0].values, (std::vector<Value>{"a", "b"}));
  EXPECT_EQ(g.where[1].values, std::vector<Value>{int64_t{3}});
  EXPECT_EQ(g.min, 0.5);
  EXPECT_EQ(g.max, 1.0);
  EXPECT_EQ(g.baseline->rule, BaselineRule::not_worse);
  EXPECT_EQ(g.baseline->allowed, 0.1);
  EXPECT_TRUE(g.baseline->relative);
  EXPECT_EQ(g.baseline->better, Better::higher) << "as the column declares";
  EXPECT_EQ(g.reason, "R");
  EXPECT_EQ(g.expected_failure, "E");
}

TEST_F(GateRulesTest, TakesTheDirectionFromTheGateWhereItStatesOne) {
  EXPECT_EQ(gate(R"({"column": "loss", "baseline": {"worse_by_at_most": 0}})").baseline->better,
            Better::lower);
  EXPECT_EQ(gate(R"({"column": "drift", "baseline": {"worse_by_at_most": 0, "better": "higher"}})")
                .baseline->better,
            Better::higher);
  EXPECT_EQ(problem(R"({"column": "drift", "baseline": {"worse_by_at_most": 0}})"),
            "g.json:1:34 (/0/baseline): which way \"drift\" gets worse is not declared; state \"better\": "
            "\"lower\" "
            "or \"higher\", or use \"differs_by_at_most\"");
}

TEST_F(GateRulesTest, NamesAGateAfterWhatItAsksFor) {
  EXPECT_EQ(
      gate(R"({"column": "alpha", "min": 0.5, "max": 1, "where": {"scene": ["a", "b"], "size": 3}})").name,
      "alpha >= 0.5 and <= 1 where scene = a | b, size = 3");
  EXPECT_EQ(gate(R"({"column": "loss", "baseline": {"worse_by_at_most": 0.1, "relative": true}})").name,
            "loss at most 0.1 of the accepted value higher than accepted");
  EXPECT_EQ(gate(R"({"column": "drift", "baseline": {"differs_by_at_most": 2}})").name,
            "drift within 2 of the accepted value");
  EXPECT_EQ(gate(R"({"column": "*", "baseline": "unchanged"})").name, "every column as accepted");
}

TEST_F(GateRulesTest, RefusesAbsoluteTimesButNotRatiosOfThem) {
  EXPECT_EQ(
      problem(R"({"column": "t_ms", "max": 5})"),
      "g.json:1:13 (/0/column): the column \"t_ms\" is an absolute time or rate (ms), which depends on the "
      "machine and on what else runs on it; gate a ratio of times, a count or a metric");
  EXPECT_NE(problem(R"({"column": "rate", "min": 5})").find("absolute time or rate (1/s)"),
            std::string::npos);
  EXPECT_EQ(gate(R"({"column": "speedup", "min": 1})").min, 1.0);
  EXPECT_EQ(gate(R"({"column": "items", "max": 7})").max, 7.0);
}

TEST_F(GateRulesTest, ExplainsWrongColumns) {
  EXPECT_EQ(problem(R"({"column": "alhpa", "min": 0})"),
            "g.json:1:13 (/0/column): unknown column \"alhpa\"; did you mean \"alpha\"?");
  EXPECT_EQ(problem(R"({"column": 7, "min": 0})"),
            "g.json:1:13 (/0/column): found 7; expected the name of a column, or \"*\"");
  EXPECT_EQ(problem(R"({"min": 0})"),
            "g.json:1:2 (/0): the key \"column\" is missing: it names what the gate bounds");
  EXPECT_EQ(problem(R"({"column": "scene", "min": 0})"),
            "g.json:1:13 (/0/column): the column \"scene\" is a key, which has no bounds; expected a metric, "
            "a count "
            "or a ratio of times");
  EXPECT_EQ(gate(R"({"column": "good", "baseline": "unchanged"})").column->name, "good");
  EXPECT_EQ(problem(R"({"column": "speedup", "baseline": "unchanged"})"),
            "g.json:1:36 (/0/baseline): the column \"speedup\" is not compared with accepted tables");
}

TEST_F(GateRulesTest, ExplainsWrongBounds) {
  EXPECT_EQ(problem(R"({"column": "alpha"})"),
            "g.json:1:2 (/0): the gate bounds nothing: expected \"min\", \"max\" or \"baseline\"");
  EXPECT_EQ(problem(R"({"column": "alpha", "min": "0"})"),
            "g.json:1:29 (/0/min): found \"0\"; expected a number");
  EXPECT_EQ(problem(R"({"column": "alpha", "min": 2, "max": 1})"),
            "g.json:1:39 (/0/max): found 1, which is below \"min\": no value passes");
  EXPECT_EQ(problem(R"({"column": "alpha", "mni": 2, "max": 1})"),
            "g.json:1:22 (/0/mni): unknown key \"mni\"; did you mean \"min\"?");
  EXPECT_EQ(problem(R"({"column": "*", "min": 0, "baseline": "unchanged"})"),
            "g.json:1:25 (/0/min): \"*\" stands for columns of many units, which have no common bound");
  EXPECT_EQ(problem(R"({"column": "*", "baseline": {"worse_by_at_most": 0}})"),
            "g.json:1:2 (/0): the column \"*\" goes with \"baseline\": \"unchanged\" only");
}

TEST_F(GateRulesTest, ExplainsWrongBaselines) {
  const auto with = [&](const std::string& baseline) {
    return problem("{\"column\": \"alpha\", \"baseline\": " + baseline + "}");
  };
  EXPECT_EQ(with("\"unchangd\""),
            "g.json:1:34 (/0/baseline): found \"unchangd\"; expected \"unchanged\" or an object {...}");
  EXPECT_EQ(with("{}"),
            "g.json:1:34 (/0/baseline): expected one of \"worse_by_at_most\" and \"differs_by_at_most\"");
  EXPECT_EQ(with("{\"worse_by_at_most\": 1, \"differs_by_at_most\": 1}"),
            "g.json:1:34 (/0/baseline): expected one of \"worse_by_at_most\" and \"differs_by_at_most\"");
  EXPECT_EQ(with("{\"worse_by_at_most\": -1}"),
            "g.json:1:55 (/0/baseline/worse_by_at_most): found -1; expected a number of at least 0");
  EXPECT_EQ(with("{\"worse_by_at_most\": 1, \"relative\": 1}"),
            "g.json:1:70 (/0/baseline/relative): found 1; expected true or false");
  EXPECT_EQ(with("{\"worse_by_at_most\": 1, \"better\": \"up\"}"),
            "g.json:1:68 (/0/baseline/better): found \"up\"; expected \"lower\" or \"higher\"");
  EXPECT_EQ(with("{\"worse_by_at_most\": 1, \"relativ\": true}"),
            "g.json:1:58 (/0/baseline/relativ): unknown key \"relativ\"; did you mean \"relative\"?");
}

TEST_F(GateRulesTest, ExplainsWrongFilters) {
  const auto with = [&](const std::string& where) {
    return problem("{\"column\": \"alpha\", \"min\": 0, \"where\": " + where + "}");
  };
  EXPECT_EQ(with("[]"), "g.json:1:41 (/0/where): found []; expected an object {...}");
  EXPECT_EQ(with("{\"scnee\": 1}"),
            "g.json:1:42 (/0/where/scnee): unknown column \"scnee\"; did you mean \"scene\"?");
  EXPECT_EQ(with("{\"loss\": 1}"),
            "g.json:1:42 (/0/where/loss): the column \"loss\" chooses no rows; expected a key or a count");
  EXPECT_EQ(with("{\"scene\": []}"),
            "g.json:1:51 (/0/where/scene): found an empty list; expected at least one value");
  EXPECT_EQ(with("{\"scene\": [null]}"),
            "g.json:1:52 (/0/where/scene/0): found null; expected text, a number, true or false");
}

TEST_F(GateRulesTest, RefusesTwoGatesOfOneName) {
  EXPECT_EQ(problem(R"({"column": "alpha", "min": 0}, {"column": "alpha", "min": 0})"),
            "g.json:1:33 (/1): the gate \"alpha >= 0\" stands twice; its first place is g.json:1:2 (/0)");
}

TEST_F(GateRulesTest, ReportsEveryProblem) {
  EXPECT_EQ(problem(R"({"column": "alpha", "min": true}, 5)"),
            "g.json:1:29 (/0/min): found true; expected a number\n"
            "g.json:1:36 (/1): found 5; expected an object {...}");
}

}  // namespace
}  // namespace hybray
