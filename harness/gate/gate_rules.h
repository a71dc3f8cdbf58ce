// Gates as they are written: every problem as one clear message, and the gates read from a list without any.
#pragma once

#include "harness/config/config_check.h"
#include "harness/gate/gate.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hybray {

// All problems of the list of gates at this JSON pointer of a document, in its order.
std::vector<Problem> gate_problems(const JsonSource& source, const std::string& pointer,
                                   const Experiment& experiment);

// The gates of a list that has no problems.
std::vector<Gate> gates_from(const nlohmann::ordered_json& list, const Experiment& experiment);

// The columns that a gate may bound: metrics, counts and ratios of times.
bool is_gateable(const Column& column);

// The columns that choose rows: keys and counts.
bool is_filter(const Column& column);

}  // namespace hybray
