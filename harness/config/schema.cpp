#include "harness/config/schema.h"

#include "harness/config/json_value.h"
#include "harness/config/parameter_rules.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

// A whole number without its ".0", so that ranges read as they were declared.
Json bound(double x) {
  return x == static_cast<double>(static_cast<int64_t>(x)) ? Json(static_cast<int64_t>(x)) : Json(x);
}

Json value_schema(const Parameter& p) {
  const std::string unit = p.unit.empty() ? "" : fmt::format(" ({})", p.unit);
  Json schema{{"description", fmt::format("{}{} Expects {}.", p.text, unit, expectation(p))}};
  const auto add_range = [&] {
    if (p.minimum) schema["minimum"] = bound(*p.minimum);
    if (p.maximum) schema["maximum"] = bound(*p.maximum);
  };
  switch (p.type) {
    case ParameterType::boolean:
      schema["type"] = "boolean";
      break;
    case ParameterType::integer:
      schema["type"] = "integer";
      add_range();
      break;
    case ParameterType::number:
      schema["type"] = "number";
      add_range();
      break;
    case ParameterType::choice:
      schema["enum"] = p.choices;
      break;
    case ParameterType::scene:
    case ParameterType::camera:
      schema["type"] = "string";
      schema["minLength"] = 1;
      break;
    case ParameterType::resolution:
      schema["type"] = "string";
      schema["pattern"] = "^[1-9][0-9]{0,4}x[1-9][0-9]{0,4}$";
      break;
  }
  if (!std::holds_alternative<std::monostate>(p.default_value)) schema["default"] = to_json(p.default_value);
  return schema;
}

Json object_of(const Json& properties, const std::string& description) {
  return {{"description", description},
          {"type", "object"},
          {"additionalProperties", false},
          {"properties", properties}};
}

Json text_of(const std::string& description) {
  return {{"description", description}, {"type", "string"}};
}

}  // namespace

nlohmann::ordered_json config_schema(const Experiment& experiment) {
  Json definitions = Json::object(), fixed = Json::object(), swept = Json::object();
  for (const Parameter& p : experiment.parameters) {
    const Json reference{{"$ref", "#/definitions/" + p.name}};
    definitions[p.name] = value_schema(p);
    fixed[p.name] = reference;
    swept[p.name] = {{"type", "array"}, {"minItems", 1}, {"uniqueItems", true}, {"items", reference}};
  }
  Json properties;
  properties["$schema"] = text_of("Path of this schema, for editors.");
  properties["experiment"] = {{"description", experiment.text}, {"const", experiment.name}};
  properties["title"] = text_of("What the run is about, in a few words.");
  properties["text"] = text_of("What the run is for.");
  properties["seed"] = {{"description", "Seed of every random number of the run."},
                        {"type", "integer"},
                        {"minimum", 0},
                        {"maximum", int64_t{9007199254740991}},
                        {"default", 1}};
  properties["parameters"] = object_of(fixed, "Parameters that have one value in the whole run.");
  properties["sweep"] =
      object_of(swept,
                "Parameters that take several values. The run has a point for each combination: the first "
                "key varies slowest, but all points of one scene come together.");
  properties["optional_scenes"] = {
      {"description",
       "Scenes of this config that are left out, with a message, where their source is missing."},
      {"type", "array"},
      {"uniqueItems", true},
      {"items", {{"type", "string"}, {"minLength", 1}}}};

  Json schema;
  schema["$schema"] = "http://json-schema.org/draft-07/schema#";
  schema["title"] = "hybray config of the experiment " + experiment.name;
  schema["description"] = "Made by `hybray describe " + experiment.name + " --schema`.";
  schema["type"] = "object";
  schema["additionalProperties"] = false;
  schema["required"] = {"experiment"};
  schema["properties"] = properties;
  schema["definitions"] = definitions;
  return schema;
}

std::string config_schema_text(const Experiment& experiment) {
  return config_schema(experiment).dump(2) + '\n';
}

}  // namespace hybray
