#include "harness/gate/gate_file.h"

#include "tests/harness/gate/gate_fixture.h"
#include "tests/harness/support/toy_experiment.h"

namespace hybray {
namespace {

class GateFileTest : public test::GateFixture {
 protected:
  GateFile load(const std::string& text, const Experiment* experiment) {
    return load_gates(folder_.write("g.json", text), experiments_, experiment);
  }
  std::string problem(const std::string& text, const Experiment* experiment) {
    return problem_of([&] { load(text, experiment); });
  }

  const std::vector<Experiment> experiments_ = test::toy_experiments();
  const Experiment* toy_ = &experiments_[0];
};

TEST_F(GateFileTest, TakesTheGatesOfAConfigAndItsExperiment) {
  const GateFile file = load(
      R"({"experiment": "toy", "parameters": {"count": 1}, "gates": [{"column": "doubled_m", "max": 3}]})",
      nullptr);
  EXPECT_EQ(file.experiment, toy_);
  ASSERT_EQ(file.gates.size(), 1u);
  EXPECT_EQ(file.gates[0].max, 3.0);
  EXPECT_TRUE(load(R"({"experiment": "toy"})", toy_).gates.empty())
      << "what --set gave the run need not stand in the config";
}

TEST_F(GateFileTest, TakesAFileOfGatesForAKnownExperiment) {
  const std::string text =
      R"({"$schema": "s", "title": "T", "text": "X", "gates": [{"column": "doubled_m", "max": 3}]})";
  EXPECT_EQ(load(text, toy_).gates.size(), 1u);
  EXPECT_EQ(problem(text, nullptr),
            "g.json: which experiment the table is of is not known: no manifest.json is "
            "beside it, and these gates name none");
}

TEST_F(GateFileTest, ExplainsWrongFiles) {
  EXPECT_EQ(problem("[]", toy_), "g.json:1:1: found []; expected an object {...}");
  EXPECT_EQ(problem("{}", toy_), "g.json:1:1: neither a config (\"experiment\") nor gates (\"gates\")");
  EXPECT_EQ(problem(R"({"experiment": "staged"})", toy_),
            "g.json:1:16 (/experiment): the config is of the experiment \"staged\", the table of \"toy\"");
  EXPECT_EQ(problem(R"({"gates": [], "titel": ""})", toy_),
            "g.json:1:15 (/titel): unknown key \"titel\"; did you mean \"title\"?");
  EXPECT_EQ(problem(R"({"gates": {}, "title": 5})", toy_),
            "g.json:1:11 (/gates): found {}; expected a list [...] of gates\n"
            "g.json:1:24 (/title): found 5; expected text");
  EXPECT_EQ(problem("{\"gates\": [\n {\"column\": \"toy_ms\",\n  \"max\": 3}]}", toy_).substr(0, 34),
            "g.json:2:13 (/gates/0/column): the");
  EXPECT_EQ(problem(R"({"experiment": "toy", "gates": [{"column": "doubled", "max": 3}]})", toy_),
            "g.json:1:44 (/gates/0/column): unknown column \"doubled\"; did you mean \"doubled_m\"?");
}

}  // namespace
}  // namespace hybray
