// A gate: what one column of a table must keep to, in which rows. Gates stand in a config or in a file of
// their own; docs/gates.md says how they are written.
#pragma once

#include "harness/experiments/experiment.h"

#include <optional>
#include <string>
#include <vector>

namespace hybray {

// Rows whose cell has one of the values.
struct GateFilter {
  const Column* column = nullptr;
  std::vector<Value> values;
};

// How a value may stand to the accepted one of the same point.
enum class BaselineRule {
  unchanged,  // within the column's declared tolerance
  not_worse,  // worse by at most `allowed`, in the direction that is worse
  near,       // higher or lower by at most `allowed`
};

struct BaselineBound {
  BaselineRule rule = BaselineRule::unchanged;
  double allowed = 0.0;  // in the column's unit, or as a share of the accepted value's magnitude
  bool relative = false;
  Better better = Better::none;  // of not_worse: which direction is
};

struct Gate {
  std::string name;                // given, or made from the rest; no two gates of a table share one
  const Column* column = nullptr;  // nullptr, with rule `unchanged`: every column that is compared
  std::vector<GateFilter> where;   // all of them must hold; empty: every row
  std::optional<double> min, max;
  std::optional<BaselineBound> baseline;
  std::string reason;
  std::string expected_failure;  // why a bound that is missed is known to be, and does not fail the run;
                                 // empty: it fails
};

// "precision >= 0.95 where scene = sphere | atrium": what a gate asks for, in words.
std::string gate_words(const Gate& gate);

// The comparison of whole tables, which stands for a config that has no gates.
Gate as_accepted();

}  // namespace hybray
