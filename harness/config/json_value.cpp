#include "harness/config/json_value.h"

#include <nlohmann/json.hpp>

namespace hybray {

Value scalar_value(const nlohmann::ordered_json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_unsigned() && json.get<uint64_t>() > INT64_MAX) return json.get<double>();
  if (json.is_number_integer()) return json.get<int64_t>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  return {};
}

std::string found_text(const nlohmann::ordered_json& json) {
  constexpr size_t kLongest = 60;
  const std::string text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

nlohmann::ordered_json to_json(const Value& value) {
  return std::visit(
      [](const auto& v) {
        if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::monostate>) {
          return nlohmann::ordered_json();
        } else {
          return nlohmann::ordered_json(v);
        }
      },
      value);
}

}  // namespace hybray
