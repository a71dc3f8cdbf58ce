#include "harness/config/parameter_rules.h"

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/tracer/seeded_camera.h"
#include "harness/config/json_value.h"
#include "harness/experiments/resolution.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string quoted_list(const std::vector<std::string>& names) {
  std::vector<std::string> quotes;
  for (const std::string& name : names) quotes.push_back(quoted(name));
  return fmt::format("{}", fmt::join(quotes, ", "));
}

std::string range_words(const Parameter& p) {
  const std::string unit = p.unit.empty() ? "" : " " + p.unit;
  if (p.minimum && p.maximum) return fmt::format(" from {} to {}{}", *p.minimum, *p.maximum, unit);
  if (p.minimum) return fmt::format(" of at least {}{}", *p.minimum, unit);
  if (p.maximum) return fmt::format(" of at most {}{}", *p.maximum, unit);
  return p.unit.empty() ? "" : " (" + p.unit + ")";
}

bool in_range(const Parameter& p, double x) {
  return (!p.minimum || x >= *p.minimum) && (!p.maximum || x <= *p.maximum);
}

bool is_text(ParameterType type) {
  return type == ParameterType::choice || type == ParameterType::scene || type == ParameterType::camera ||
         type == ParameterType::resolution;
}

// A "WIDTHxHEIGHT" text with each side in the parameter's range.
bool is_resolution(const Parameter& p, const std::string& text) {
  const auto resolution = parse_resolution(text);
  const auto [least, most] = side_range(p);
  return resolution && std::min(resolution->width, resolution->height) >= least &&
         std::max(resolution->width, resolution->height) <= most;
}

// What stands on a command line, read as JSON where it is some; text otherwise.
Value parse_scalar(const std::string& text) {
  const auto json = nlohmann::ordered_json::parse(text, nullptr, false);
  return json.is_boolean() || json.is_number() ? scalar_value(json) : Value(text);
}

}  // namespace

std::string expectation(const Parameter& p) {
  switch (p.type) {
    case ParameterType::boolean:
      return "true or false";
    case ParameterType::integer:
      return "an integer" + range_words(p);
    case ParameterType::number:
      return "a number" + range_words(p);
    case ParameterType::choice:
      return (p.choices.size() > 1 ? "one of " : "") + quoted_list(p.choices);
    case ParameterType::scene:
      return "the name of a scene";
    case ParameterType::camera:
      return fmt::format(
          "the name of a camera, \"*\" for each camera of the scene, \"seeded/N\" (N from 0 to {}) for the "
          "N-th of the cameras that a generator places in any scene, or \"seeded*COUNT\" (1 to {}) for the "
          "first so many of them",
          kLargestSeededCamera, kMostSeededCameras);
    case ParameterType::resolution: {
      const auto [least, most] = side_range(p);
      return fmt::format("\"WIDTHxHEIGHT\" with each side {} to {}", least, most);
    }
  }
  return {};
}

bool accept(const Parameter& p, Value& value) {
  if (p.type == ParameterType::boolean) return std::holds_alternative<bool>(value);
  if (p.type == ParameterType::integer || p.type == ParameterType::number) {
    const auto* integer = std::get_if<int64_t>(&value);
    if (p.type == ParameterType::number && integer) value = static_cast<double>(*integer);
    if (value == Value(0.0)) value = 0.0;  // -0 is the same number, so it may not make another point
    const auto* number = std::get_if<double>(&value);
    if (p.type == ParameterType::integer) return integer && in_range(p, static_cast<double>(*integer));
    return number && in_range(p, *number);
  }
  const auto* text = std::get_if<std::string>(&value);
  if (!text) return false;
  if (p.type == ParameterType::resolution) return is_resolution(p, *text);
  if (p.type == ParameterType::choice) {
    return std::find(p.choices.begin(), p.choices.end(), *text) != p.choices.end();
  }
  if (p.type == ParameterType::camera && begins_like_seeded_camera(*text))
    return seeded_camera_number(*text) || seeded_camera_count(*text);
  return !text->empty();
}

std::string json_text(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return quoted(*text);
  return std::holds_alternative<std::monostate>(value) ? "null" : to_text(value);
}

std::string rejection(const Parameter& p, const std::string& found, const Value& value) {
  std::string message = fmt::format("found {}; expected {}", found, expectation(p));
  const auto* text = std::get_if<std::string>(&value);
  if (p.type == ParameterType::choice && text) {
    const std::string nearest = nearest_name(*text, p.choices);
    if (!nearest.empty()) message += fmt::format("; did you mean \"{}\"?", nearest);
  }
  return message;
}

Value value_from_text(const Parameter& p, const std::string& text, const std::string& place) {
  Value value = is_text(p.type) ? Value(text) : parse_scalar(text);
  if (accept(p, value)) return value;
  throw InputError(place, rejection(p, json_text(value), value));
}

bool stands_for_every_camera(const Parameter& p, const Value& value) {
  return p.type == ParameterType::camera && value == Value("*");
}

bool stands_for_cameras(const Parameter& p, const Value& value) {
  return stands_for_every_camera(p, value) || expanded(p, value) != std::vector{value};
}

std::vector<Value> expanded(const Parameter& p, const Value& value) {
  const auto* text = std::get_if<std::string>(&value);
  const std::optional<uint32_t> count =
      p.type == ParameterType::camera && text ? seeded_camera_count(*text) : std::nullopt;
  if (!count) return {value};
  std::vector<Value> values;
  for (uint32_t n = 0; n < *count; ++n) values.push_back(seeded_camera_name(n));
  return values;
}

std::string star_problem(const Parameter& p, const Value& value, size_t count) {
  if (count == 1 || !stands_for_every_camera(p, value)) return "";
  return "\"*\" stands for every camera of the scene, so it must be the only value here";
}

const Parameter* find_parameter(const Experiment& experiment, const std::string& name) {
  for (const Parameter& p : experiment.parameters) {
    if (p.name == name) return &p;
  }
  return nullptr;
}

const Parameter* parameter_of_type(const Experiment& experiment, ParameterType type) {
  for (const Parameter& p : experiment.parameters) {
    if (p.type == type) return &p;
  }
  return nullptr;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(name, known);
  if (!nearest.empty()) return fmt::format("; did you mean \"{}\"?", nearest);
  return known.empty() ? "" : fmt::format("; known are: {}", fmt::join(known, ", "));
}

std::string unknown_name(const std::string& what, const std::string& name,
                         const std::vector<std::string>& known) {
  return fmt::format("unknown {} {}{}", what, quoted(name), suggestion(name, known));
}

std::string unknown_parameter(const Experiment& experiment, const std::string& name) {
  std::vector<std::string> known;
  for (const Parameter& p : experiment.parameters) known.push_back(p.name);
  return unknown_name("parameter", name, known);
}

std::string unknown_experiment(const std::string& name, std::span<const Experiment> experiments) {
  std::vector<std::string> known;
  for (const Experiment& e : experiments) known.push_back(e.name);
  return unknown_name("experiment", name, known);
}

std::pair<int64_t, int64_t> side_range(const Parameter& p) {
  return {static_cast<int64_t>(p.minimum.value_or(1)), static_cast<int64_t>(p.maximum.value_or(65536))};
}

}  // namespace hybray
