#include "harness/gate/gate_schema.h"

#include "harness/gate/gate_rules.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

Json text_of(const std::string& description) {
  return {{"description", description}, {"type", "string"}, {"minLength", 1}};
}

Json number_of(const std::string& description) {
  return {{"description", description}, {"type", "number"}};
}

Json amount_of(const std::string& description) {
  Json schema = number_of(description);
  schema["minimum"] = 0;
  return schema;
}

Json column_names(std::span<const Experiment> experiments) {
  Json names = Json::array();
  for (const Experiment& experiment : experiments) {
    for (const Column& column : experiment.columns) {
      const bool wanted = is_gateable(column) || comparison_of(column) == Comparison::value;
      if (wanted && std::find(names.begin(), names.end(), column.name) == names.end())
        names.push_back(column.name);
    }
  }
  names.push_back("*");
  return names;
}

Json filters(std::span<const Experiment> experiments) {
  // "minItems" and "items" bind lists only.
  const Json values{{"type", {"string", "number", "boolean", "array"}},
                    {"minItems", 1},
                    {"items", {{"type", {"string", "number", "boolean"}}}}};
  Json properties = Json::object();
  for (const Experiment& experiment : experiments) {
    for (const Column& column : experiment.columns) {
      if (!is_filter(column) || properties.contains(column.name)) continue;
      Json& filter = properties[column.name] = values;
      filter["description"] = column.text;
    }
  }
  return {
      {"description", "Only rows whose cells have these values, or one of a list; without it, every row."},
      {"type", "object"},
      {"additionalProperties", false},
      {"properties", properties}};
}

Json baseline() {
  Json amounts = Json::object();
  amounts["worse_by_at_most"] = amount_of("How much worse than the accepted value it may be.");
  amounts["differs_by_at_most"] = amount_of("How far from the accepted value it may be, either way.");
  amounts["relative"] = {{"description", "Whether that is a share of the accepted value."},
                         {"type", "boolean"},
                         {"default", false}};
  amounts["better"] = {{"description", "Which way is better; by default as the column declares it."},
                       {"enum", {"lower", "higher"}}};
  const Json object{{"type", "object"},
                    {"additionalProperties", false},
                    {"oneOf", {{{"required", {"worse_by_at_most"}}}, {{"required", {"differs_by_at_most"}}}}},
                    {"properties", amounts}};
  return {{"description",
           "How the value may stand to the accepted one of the same point; \"unchanged\": within the "
           "tolerance that "
           "the column declares."},
          {"anyOf", {{{"const", "unchanged"}}, object}}};
}

}  // namespace

nlohmann::ordered_json gates_schema(std::span<const Experiment> experiments) {
  Json properties;
  properties["name"] = text_of("What reports call the gate.");
  properties["column"] = {{"description",
                           "What the gate bounds: a metric, a count or a ratio of times; \"*\", with "
                           "\"baseline\": \"unchanged\": every "
                           "column that is compared."},
                          {"enum", column_names(experiments)}};
  properties["where"] = filters(experiments);
  properties["min"] = number_of("Least value that passes, in the column's unit.");
  properties["max"] = number_of("Greatest value that passes, in the column's unit.");
  properties["baseline"] = baseline();
  properties["reason"] = text_of("Why the bound is what it is.");
  properties["expected_failure"] =
      text_of("Why this bound is known to be missed: that is reported, and does not fail the run.");
  return {{"description", "What the table must keep to; `hybray check` tells."},
          {"type", "array"},
          {"items",
           {{"type", "object"},
            {"additionalProperties", false},
            {"required", {"column"}},
            {"anyOf", {{{"required", {"min"}}}, {{"required", {"max"}}}, {{"required", {"baseline"}}}}},
            {"properties", properties}}}};
}

nlohmann::ordered_json gate_file_schema(std::span<const Experiment> experiments) {
  Json properties;
  properties["$schema"] = text_of("Path of this schema, for editors.");
  properties["title"] = text_of("What the gates are about, in a few words.");
  properties["text"] = text_of("What the gates are for.");
  properties["gates"] = gates_schema(experiments);
  Json schema;
  schema["$schema"] = "http://json-schema.org/draft-07/schema#";
  schema["title"] = "hybray gates";
  schema["description"] = "Made by `hybray describe --gate-schema`.";
  schema["type"] = "object";
  schema["additionalProperties"] = false;
  schema["required"] = {"gates"};
  schema["properties"] = properties;
  return schema;
}

std::string gate_file_schema_text(std::span<const Experiment> experiments) {
  return gate_file_schema(experiments).dump(2) + '\n';
}

}  // namespace hybray
