// KEY=VALUE: what the command line or a suite changes in a config, or asks of its points.
#pragma once

#include "harness/experiments/experiment.h"

#include <span>
#include <string>
#include <vector>

namespace hybray {

struct Assignment {
  std::string key, text;  // text: the value as it stands after the "="
  std::string place;      // where it was given, as messages name it
};

// The arguments of an option of the command line, "--set" or "--filter". Throws InputError where one is not
// KEY=VALUE.
std::vector<Assignment> assignments_of(const std::string& option, std::span<const std::string> arguments);

// The values that an assignment gives `parameter`, at least one: a single value; several, with commas between
// them; or, as JSON, a list or a range ("[1, 2]", "{"from": 1, "to": 8, "count": 4}"). Throws InputError for
// what the parameter does not accept, and for a value that stands twice.
std::vector<Value> values_of(const Assignment& assignment, const Parameter& parameter);

}  // namespace hybray
