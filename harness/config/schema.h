// The JSON Schema (draft 7) of an experiment's configs, made from its declaration, and the check of a
// document against it.
#pragma once

#include "harness/experiments/experiment.h"

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace hybray {

nlohmann::ordered_json config_schema(const Experiment& experiment);

// As it stands in configs/schema/NAME.schema.json.
std::string config_schema_text(const Experiment& experiment);

struct SchemaViolation {
  std::string pointer;  // JSON pointer of the value that the schema rejects
  std::string message;
};

// What the schema rejects in `document`, by valijson; empty: nothing.
std::vector<SchemaViolation> schema_violations(const nlohmann::ordered_json& schema,
                                               const nlohmann::ordered_json& document);

}  // namespace hybray
