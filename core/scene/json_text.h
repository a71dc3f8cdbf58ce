// JSON text from strangers: parsed with a limit on nesting, and with errors that name line and column.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace hybray {

// The parsed text. Throws InputError("file:line:column", ...) for a syntax error, a number too large for a
// double, and arrays or objects nested deeper than 64 levels (which would exhaust the stack of whoever walks
// them).
nlohmann::json parse_json(std::string_view text, const std::string& file);

}  // namespace hybray
