// Table and parameter values from JSON scalars and back.
#pragma once

#include "harness/table/value.h"

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace hybray {

// A JSON scalar as a Value; null, lists and objects become monostate.
Value scalar_value(const nlohmann::ordered_json& json);

// A value as messages repeat it: JSON on one line, shortened where it is long.
std::string found_text(const nlohmann::ordered_json& json);

// The JSON scalar of a Value; monostate becomes null.
nlohmann::ordered_json to_json(const Value& value);

}  // namespace hybray
