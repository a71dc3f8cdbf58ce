#include "harness/config/schema.h"

#include "harness/config/json_value.h"
#include "harness/config/parameter_rules.h"
#include "harness/config/range.h"
#include "harness/gate/gate_schema.h"

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

// What "sweep" takes for a parameter: a list, or for numbers a range. Of the keywords, JSON Schema applies
// those of lists to lists alone, and those of objects to objects.
Json swept_schema(const Parameter& p, const Json& value) {
  Json schema{{"type", "array"}, {"minItems", 1}, {"uniqueItems", true}, {"items", value}};
  if (!takes_range(p)) return schema;
  schema["type"] = {"array", "object"};
  schema["additionalProperties"] = false;
  schema["required"] = {"from", "to"};
  schema["properties"] = {{"from", value},
                          {"to", value},
                          {"count", {{"$ref", "#/definitions/range:count"}}},
                          {"step", {{"$ref", "#/definitions/range:step"}}},
                          {"scale", {{"$ref", "#/definitions/range:scale"}}}};
  schema["anyOf"] = {{{"required", {"count"}}}, {{"required", {"step"}}}};
  schema["not"] = {{"type", "object"}, {"required", {"count", "step"}}};
  return schema;
}

// What all ranges have in common. No parameter's name has a colon in it.
void add_range_definitions(Json& definitions) {
  definitions["range:count"] = {{"description", "Number of values, both ends included."},
                                {"type", "integer"},
                                {"minimum", 2},
                                {"maximum", kMostRangeValues}};
  definitions["range:step"] = {
      {"description",
       "Difference from one value to the next, or on the log scale their ratio; must lead to \"to\"."},
      {"type", "number"}};
  definitions["range:scale"] = {
      {"description", "Whether values are evenly spaced by difference or by ratio."},
      {"enum", {"linear", "log"}},
      {"default", "linear"}};
}

Json schema_head(const std::string& title, const std::string& made_by) {
  return {{"$schema", "http://json-schema.org/draft-07/schema#"},
          {"title", title},
          {"description", fmt::format("Made by `{}`.", made_by)},
          {"type", "object"},
          {"additionalProperties", false}};
}

}  // namespace

nlohmann::ordered_json config_schema(const Experiment& experiment) {
  Json definitions = Json::object(), all = Json::object(), of_a_scene = Json::object(),
       swept = Json::object();
  for (const Parameter& p : experiment.parameters) {
    const Json reference{{"$ref", "#/definitions/" + p.name}};
    definitions[p.name] = value_schema(p);
    all[p.name] = reference;
    if (p.type != ParameterType::scene) of_a_scene[p.name] = reference;
    swept[p.name] = swept_schema(p, reference);
  }
  add_range_definitions(definitions);
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
  properties["parameters"] = object_of(all, "Parameters that have one value in the whole run.");
  properties["points"] = {{"description",
                           "Points of the run, one by one. Each is combined with every combination of the "
                           "sweep; what it leaves out "
                           "comes from \"scenes\", \"parameters\" or the default."},
                          {"type", "array"},
                          {"minItems", 1},
                          {"uniqueItems", true},
                          {"items", object_of(all, "Parameters of one point.")}};
  properties["sweep"] = object_of(
      swept,
      "Parameters that take several values: a list, or for numbers a range. The run has a point for "
      "each combination: the first key varies slowest, but all points of one scene come together.");
  if (parameter_of_type(experiment, ParameterType::scene)) {
    properties["scenes"] = {
        {"description",
         "Parameters that have another value for the points of one scene, by the scene's name."},
        {"type", "object"},
        {"additionalProperties", object_of(of_a_scene, "Parameters of this scene's points.")}};
  }
  properties["optional_scenes"] = {
      {"description",
       "Scenes of this config that are left out, with a message, where their source is missing."},
      {"type", "array"},
      {"uniqueItems", true},
      {"items", {{"type", "string"}, {"minLength", 1}}}};
  properties["gates"] = gates_schema({&experiment, 1});

  Json schema = schema_head("hybray config of the experiment " + experiment.name,
                            fmt::format("hybray describe {} --schema", experiment.name));
  schema["required"] = {"experiment"};
  schema["properties"] = properties;
  schema["definitions"] = definitions;
  return schema;
}

nlohmann::ordered_json suite_schema() {
  const Json file{
      {"description", "Path of a config, from this file's folder."}, {"type", "string"}, {"minLength", 1}};
  const auto values_of_keys = [](const char* description) {
    return Json{{"description", description},
                {"type", "object"},
                {"additionalProperties", {{"type", {"boolean", "number", "string", "array", "object"}}}}};
  };
  Json entry = object_of(
      {{"config", file},
       {"set",
        values_of_keys("As `--set`: a value replaces a parameter of this config, a list or a range makes a "
                       "sweep of it.")},
       {"filter", values_of_keys("As `--filter`: keep only the points that match; of a list, any value.")}},
      "A config: its path, or an object of path and changes.");
  entry["type"] = {"string", "object"};
  entry["minLength"] = 1;
  entry["required"] = {"config"};
  Json schema = schema_head("hybray suite", "hybray describe suite --schema");
  schema["required"] = {"configs"};
  schema["properties"] = {{"$schema", text_of("Path of this schema, for editors.")},
                          {"title", text_of("What the suite is about, in a few words.")},
                          {"text", text_of("What the suite is for.")},
                          {"configs",
                           {{"description", "The configs, in the order in which they run."},
                            {"type", "array"},
                            {"minItems", 1},
                            {"uniqueItems", true},
                            {"items", entry}}}};
  return schema;
}

std::string config_schema_text(const Experiment& experiment) {
  return config_schema(experiment).dump(2) + '\n';
}

std::string suite_schema_text() {
  return suite_schema().dump(2) + '\n';
}

}  // namespace hybray
