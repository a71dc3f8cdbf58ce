// One cell of a table, or one parameter of a point.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

namespace hybray {

// std::monostate = not applicable: an empty cell. Never NaN.
using Value = std::variant<std::monostate, bool, int64_t, double, std::string>;

// Text of a value as it stands in a CSV cell, before quoting: shortest decimal that reads back as the same
// double; true / false; empty.
std::string to_text(const Value& value);

}  // namespace hybray
