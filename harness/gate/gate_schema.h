// The JSON Schema (draft 7) of gates, made from the columns that experiments declare.
#pragma once

#include "harness/experiments/experiment.h"

#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace hybray {

// Of the list of gates in a config of one experiment, or in a file for any of several.
nlohmann::ordered_json gates_schema(std::span<const Experiment> experiments);

// Of a file of gates, as it stands in configs/schema/gates.schema.json.
nlohmann::ordered_json gate_file_schema(std::span<const Experiment> experiments);
std::string gate_file_schema_text(std::span<const Experiment> experiments);

}  // namespace hybray
