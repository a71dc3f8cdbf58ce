#include "core/scene/json_object.h"

#include "core/base/error.h"
#include "core/base/nearest_name.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {

using nlohmann::json;

JsonObject::JsonObject(const json& value, std::string file, std::string pointer,
                       std::initializer_list<const char*> known)
    : value_(value), file_(std::move(file)), pointer_(std::move(pointer)) {
  if (!value_.is_object())
    throw InputError(pointer_.empty() ? file_ : file_ + ": " + pointer_,
                     fmt::format("expected an object, found {}", value_.type_name()));
  const std::vector<std::string> names(known.begin(), known.end());
  for (const auto& [key, ignored] : value_.items()) {
    if (std::find(names.begin(), names.end(), key) != names.end()) continue;
    const std::string nearest = nearest_name(key, names);
    throw InputError(file_ + ": " + pointer_ + "/" + key,
                     nearest.empty()
                         ? fmt::format("unknown key '{}'; known here: {}", key, fmt::join(names, ", "))
                         : fmt::format("unknown key '{}'; did you mean '{}'?", key, nearest));
  }
}

bool JsonObject::has(const char* key) const {
  return value_.contains(key);
}

const json& JsonObject::value(const char* key) const {
  if (!has(key)) fail(key, "missing");
  return value_[key];
}

std::string JsonObject::text(const char* key) const {
  const json& found = value(key);
  if (!found.is_string()) fail(key, fmt::format("expected text, found {}", found.type_name()));
  const auto& result = found.get_ref<const std::string&>();
  if (result.empty()) fail(key, "empty");
  return result;
}

std::string JsonObject::text(const char* key, const std::string& otherwise) const {
  return has(key) ? text(key) : otherwise;
}

double JsonObject::number(const char* key, Range range) const {
  const json& found = value(key);
  if (!found.is_number()) fail(key, fmt::format("expected a number, found {}", found.type_name()));
  const auto result = found.get<double>();
  if (!(result >= range.lower && result <= range.upper))
    fail(key, fmt::format("{} is not between {} and {}", result, range.lower, range.upper));
  return result;
}

double JsonObject::number(const char* key, double otherwise, Range range) const {
  return has(key) ? number(key, range) : otherwise;
}

int64_t JsonObject::integer(const char* key, int64_t otherwise, Range range) const {
  if (!has(key)) return otherwise;
  if (!value(key).is_number_integer()) fail(key, "expected a whole number");
  number(key, range);
  return value(key).get<int64_t>();
}

bool JsonObject::boolean(const char* key, bool otherwise) const {
  if (!has(key)) return otherwise;
  if (!value(key).is_boolean()) fail(key, "expected true or false");
  return value(key).get<bool>();
}

vec3 JsonObject::vector(const char* key, Range range) const {
  const json& found = value(key);
  if (!found.is_array() || found.size() != 3 ||
      !std::all_of(found.begin(), found.end(), [](const json& v) { return v.is_number(); }))
    fail(key, "expected an array of three numbers");
  vec3 result;
  for (int c = 0; c < 3; ++c) {
    const auto component = found[static_cast<size_t>(c)].get<double>();
    if (!(component >= range.lower && component <= range.upper))
      fail(key, fmt::format("{} is not between {} and {}", component, range.lower, range.upper));
    result[c] = static_cast<float>(component);
  }
  return result;
}

vec3 JsonObject::vector(const char* key, const vec3& otherwise, Range range) const {
  return has(key) ? vector(key, range) : otherwise;
}

std::vector<const json*> JsonObject::elements(const char* key) const {
  std::vector<const json*> list;
  if (!has(key)) return list;
  if (!value(key).is_array()) fail(key, "expected an array");
  for (const json& element : value(key)) list.push_back(&element);
  return list;
}

std::string JsonObject::pointer(const char* key) const {
  return pointer_ + "/" + key;
}

std::string JsonObject::pointer(const char* key, size_t element) const {
  return fmt::format("{}/{}/{}", pointer_, key, element);
}

std::string JsonObject::where(const char* key) const {
  return file_ + ": " + pointer(key);
}

void JsonObject::fail(const char* key, const std::string& message) const {
  throw InputError(where(key), message);
}

}  // namespace hybray
