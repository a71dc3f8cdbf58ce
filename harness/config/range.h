// A range of numbers in a sweep: {"from": 1, "to": 16, "count": 5, "scale": "log"}, or with "step" for
// "count".
#pragma once

#include "harness/experiments/experiment.h"

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace hybray {

constexpr int64_t kMostRangeValues = 10'000;

// What is wrong with a range: at one of its members, at a member's key, or (no member) as a whole.
struct RangeProblem {
  std::string member, message;
  bool at_key = false;
};

// Whether a range can give this parameter its values: integers and numbers only.
bool takes_range(const Parameter& parameter);

// The values of `range`, an object, in its own order: both ends, and evenly spaced values between them, by
// difference (`scale` linear) or by ratio (log). The ends are as given; what lies between is rounded to 12
// significant digits, on the linear scale those of the larger end, so that a range gives the same numbers
// that a person would write. An integer parameter accepts integers only. Empty, with at least one of
// `problems`, where something is wrong.
std::vector<Value> range_values(const Parameter& parameter, const nlohmann::ordered_json& range,
                                std::vector<RangeProblem>& problems);

}  // namespace hybray
