// The JSON Schemas (draft 7) of configs, each made from its experiment's declaration, and of suites; and the
// check of a document against one.
#pragma once

#include "harness/experiments/experiment.h"

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace hybray {

nlohmann::ordered_json config_schema(const Experiment& experiment);

nlohmann::ordered_json suite_schema();

// As they stand in configs/schema/NAME.schema.json and configs/schema/suite.schema.json.
std::string config_schema_text(const Experiment& experiment);
std::string suite_schema_text();

struct SchemaViolation {
  std::string pointer;  // JSON pointer of the value that the schema rejects
  std::string message;
};

// What the schema rejects in `document`, by valijson; empty: nothing.
std::vector<SchemaViolation> schema_violations(const nlohmann::ordered_json& schema,
                                               const nlohmann::ordered_json& document);

}  // namespace hybray
