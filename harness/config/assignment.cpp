#include "harness/config/assignment.h"

#include "core/base/error.h"
#include "harness/config/json_value.h"
#include "harness/config/parameter_rules.h"
#include "harness/config/range.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

std::vector<Value> listed(const Assignment& assignment, const Parameter& parameter, const Json& list) {
  std::vector<Value> values;
  for (const Json& item : list) {
    Value value = scalar_value(item);
    if (!accept(parameter, value))
      throw InputError(assignment.place, rejection(parameter, found_text(item), value));
    values.push_back(value);
  }
  if (values.empty()) throw InputError(assignment.place, "found an empty list; expected at least one value");
  return values;
}

std::vector<Value> ranged(const Assignment& assignment, const Parameter& parameter, const Json& range) {
  std::vector<RangeProblem> problems;
  const std::vector<Value> values = range_values(parameter, range, problems);
  if (problems.empty()) return values;
  const RangeProblem& first = problems.front();
  throw InputError(assignment.place,
                   (first.member.empty() ? "" : "\"" + first.member + "\": ") + first.message);
}

std::vector<Value> separated(const Assignment& assignment, const Parameter& parameter) {
  std::vector<Value> values;
  for (size_t start = 0; start <= assignment.text.size();) {
    const size_t comma = std::min(assignment.text.find(',', start), assignment.text.size());
    values.push_back(
        value_from_text(parameter, assignment.text.substr(start, comma - start), assignment.place));
    start = comma + 1;
  }
  return values;
}

std::vector<Value> all_values(const Assignment& assignment, const Parameter& parameter) {
  const char first = assignment.text.empty() ? ' ' : assignment.text.front();
  if (first != '[' && first != '{') return separated(assignment, parameter);
  const Json json = Json::parse(assignment.text, nullptr, false);
  if (json.is_array()) return listed(assignment, parameter, json);
  if (json.is_object() && takes_range(parameter)) return ranged(assignment, parameter, json);
  throw InputError(assignment.place, fmt::format("found {}; expected {}, or a list [...] of such",
                                                 json_text(assignment.text), expectation(parameter)));
}

}  // namespace

std::vector<Assignment> assignments_of(const std::string& option, std::span<const std::string> arguments) {
  std::vector<Assignment> assignments;
  for (const std::string& argument : arguments) {
    const std::string place = option + " " + argument;
    const size_t equals = argument.find('=');
    if (equals == std::string::npos || equals == 0) throw InputError(place, "expected KEY=VALUE");
    assignments.push_back({argument.substr(0, equals), argument.substr(equals + 1), place});
  }
  return assignments;
}

std::vector<Value> values_of(const Assignment& assignment, const Parameter& parameter) {
  std::vector<Value> values = all_values(assignment, parameter);
  for (auto value = values.begin(); value != values.end(); ++value) {
    if (std::find(values.begin(), value, *value) != value)
      throw InputError(assignment.place,
                       fmt::format("the value {} stands twice in this list", json_text(*value)));
  }
  return values;
}

}  // namespace hybray
