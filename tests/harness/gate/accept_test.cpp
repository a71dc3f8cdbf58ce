#include "harness/gate/accept.h"

#include "tests/harness/gate/gate_fixture.h"

namespace hybray {
namespace {

using AcceptTest = test::GateFixture;
using Lines = std::vector<std::string>;

TEST_F(AcceptTest, KeepsKeysAndComparedColumnsThatHaveValues) {
  const Acceptance acceptance = prepare_acceptance(
      table("1,\"a,b\",7,0.5,,,10,true,m,1.5,9,8\n2,c,7,,,,20,true,m,1.5,9,8\n"), {}, no_baseline());
  EXPECT_EQ(acceptance.csv, "scene,size,alpha,items,good\n\"a,b\",7,0.5,10,true\nc,7,,20,true\n");
  EXPECT_EQ(acceptance.changes, Lines{});
}

TEST_F(AcceptTest, KeepsWhatAGateHoldsAgainstAcceptedValues) {
  const auto with = gates(R"([{"column": "speedup", "baseline": {"worse_by_at_most": 0.5}}])");
  EXPECT_EQ(prepare_acceptance(table("1,a,7,0.5,,,,,m,1.5,9,8\n"), with, no_baseline()).csv,
            "scene,size,alpha,speedup\na,7,0.5,1.5\n");
}

TEST_F(AcceptTest, TellsWhatChangesAndCanBeCheckedAfterwards) {
  const GatedTable t = table("1,a,7,0.75,0.5,,,,,,,\n");
  const Acceptance acceptance =
      prepare_acceptance(t, {}, baseline("scene,size,alpha,loss\na,7,0.5,0.25\nb,7,0,0\n"));
  EXPECT_EQ(acceptance.changes, (Lines{"scene=b: the row is accepted, but missing",
                                       "line 2: loss was 0.25, is 0.5 (+0.25; tolerance 0)"}));
  EXPECT_EQ(acceptance.moved, 1u) << "alpha, within its tolerance";
  EXPECT_EQ(evaluate(as_accepted(), t, baseline(acceptance.csv)).status, GateStatus::passed);
}

TEST_F(AcceptTest, RefusesWhatCannotBeHeldAgainstAnything) {
  EXPECT_EQ(problem_of([&] { prepare_acceptance(table("1,a,7,nan,,,,,,,,\n"), {}, no_baseline()); }),
            "t.csv:2: found nan in the column \"alpha\"; expected a finite number, or nothing");
  EXPECT_EQ(problem_of([&] { prepare_acceptance(table(""), {}, no_baseline()); }),
            "t.csv: the table has no rows to accept");
}

}  // namespace
}  // namespace hybray
