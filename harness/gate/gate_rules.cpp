#include "harness/gate/gate_rules.h"

#include "harness/config/json_value.h"
#include "harness/config/parameter_rules.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> kGateKeys = {"name", "column",   "where",  "min",
                                            "max",  "baseline", "reason", "expected_failure"};
const std::vector<std::string> kBaselineKeys = {"worse_by_at_most", "differs_by_at_most", "relative",
                                                "better"};

const Column* find_column(const Experiment& experiment, const std::string& name) {
  for (const Column& column : experiment.columns) {
    if (column.name == name) return &column;
  }
  return nullptr;
}

template <class Wanted>
std::string unknown_column(const Experiment& experiment, const std::string& name, const Wanted& wanted) {
  std::vector<std::string> known;
  for (const Column& column : experiment.columns) {
    if (wanted(column)) known.push_back(column.name);
  }
  return unknown_name("column", name, known);
}

// Collects the problems of one list of gates.
class Checker {
 public:
  Checker(const JsonSource& source, const Experiment& experiment)
      : source_(source), experiment_(experiment) {}

  std::vector<Problem> run(const std::string& pointer) {
    const Json& list = source_.root()[Json::json_pointer(pointer)];
    if (!list.is_array()) {
      found(pointer, list, "a list [...] of gates");
      return std::move(problems_);
    }
    for (size_t i = 0; i < list.size(); ++i) gate(child_pointer(pointer, i), list[i]);
    if (problems_.empty()) repeated_names(pointer, list);
    return std::move(problems_);
  }

 private:
  void at_value(const std::string& pointer, const std::string& message) {
    problems_.push_back({source_.place(pointer), message});
  }
  void found(const std::string& pointer, const Json& value, const std::string& expected) {
    at_value(pointer, fmt::format("found {}; expected {}", found_text(value), expected));
  }

  bool is_object(const std::string& pointer, const Json& value) {
    if (!value.is_object()) found(pointer, value, "an object {...}");
    return value.is_object();
  }

  void unknown_keys(const std::string& pointer, const Json& object, const std::vector<std::string>& known) {
    for (const auto& [key, value] : object.items()) {
      if (std::find(known.begin(), known.end(), key) == known.end())
        problems_.push_back(
            {source_.key_place(child_pointer(pointer, key)), unknown_name("key", key, known)});
    }
  }

  void gate(const std::string& pointer, const Json& json) {
    if (!is_object(pointer, json)) return;
    unknown_keys(pointer, json, kGateKeys);
    for (const char* key : {"name", "reason", "expected_failure"}) {
      if (json.contains(key) && (!json[key].is_string() || json[key].get_ref<const std::string&>().empty()))
        found(child_pointer(pointer, key), json[key], "text");
    }
    const bool all = json.contains("column") && json["column"] == "*";
    const Column* column = all ? nullptr : the_column(pointer, json);
    if (json.contains("where")) where(child_pointer(pointer, "where"), json["where"]);
    for (const char* key : {"min", "max"}) bound(child_pointer(pointer, key), json, key, all);
    if (all && (!json.contains("baseline") || json["baseline"] != "unchanged"))
      at_value(pointer, "the column \"*\" goes with \"baseline\": \"unchanged\" only");
    else if (json.contains("baseline"))
      baseline(child_pointer(pointer, "baseline"), json["baseline"], column);
    else if (!json.contains("min") && !json.contains("max"))
      at_value(pointer, "the gate bounds nothing: expected \"min\", \"max\" or \"baseline\"");
    order(pointer, json);
  }

  const Column* the_column(const std::string& pointer, const Json& json) {
    const std::string place = child_pointer(pointer, "column");
    if (!json.contains("column")) {
      at_value(pointer, "the key \"column\" is missing: it names what the gate bounds");
      return nullptr;
    }
    const Json& name = json["column"];
    if (!name.is_string()) {
      found(place, name, "the name of a column, or \"*\"");
      return nullptr;
    }
    const Column* column = find_column(experiment_, name.get<std::string>());
    const bool unchanged = json.contains("baseline") && json["baseline"] == "unchanged" &&
                           !json.contains("min") && !json.contains("max");
    if (!column) {
      at_value(place, unknown_column(experiment_, name.get<std::string>(), is_gateable));
    } else if (column->kind == ColumnKind::time && column->unit != "1") {
      at_value(place,
               fmt::format("the column \"{}\" is an absolute time or rate ({}), which depends on the "
                           "machine and on what else runs on it; gate a ratio of times, a count or a metric",
                           column->name, column->unit));
    } else if (column->kind == ColumnKind::key &&
               !(unchanged && comparison_of(*column) == Comparison::value)) {
      at_value(place,
               fmt::format("the column \"{}\" is a key, which has no bounds; expected a metric, a count or "
                           "a ratio of times",
                           column->name));
    }
    return column;
  }

  void bound(const std::string& pointer, const Json& json, const char* key, bool all) {
    if (!json.contains(key)) return;
    if (!json[key].is_number()) found(pointer, json[key], "a number");
    if (all) at_value(pointer, "\"*\" stands for columns of many units, which have no common bound");
  }

  void order(const std::string& pointer, const Json& json) {
    if (!json.contains("min") || !json.contains("max")) return;
    const Json &min = json["min"], &max = json["max"];
    if (min.is_number() && max.is_number() && min.get<double>() > max.get<double>()) {
      at_value(child_pointer(pointer, "max"),
               fmt::format("found {}, which is below \"min\": no value passes", found_text(max)));
    }
  }

  void where(const std::string& pointer, const Json& object) {
    if (!is_object(pointer, object)) return;
    for (const auto& [name, values] : object.items()) {
      const std::string member = child_pointer(pointer, name);
      const Column* column = find_column(experiment_, name);
      if (!column)
        problems_.push_back({source_.key_place(member), unknown_column(experiment_, name, is_filter)});
      else if (!is_filter(*column))
        problems_.push_back(
            {source_.key_place(member),
             fmt::format("the column \"{}\" chooses no rows; expected a key or a count", name)});
      if (values.is_array() && values.empty())
        at_value(member, "found an empty list; expected at least one value");
      if (!values.is_array()) filter_value(member, values);
      for (size_t i = 0; values.is_array() && i < values.size(); ++i)
        filter_value(child_pointer(member, i), values[i]);
    }
  }

  void filter_value(const std::string& pointer, const Json& value) {
    if (std::holds_alternative<std::monostate>(scalar_value(value)))
      found(pointer, value, "text, a number, true or false");
  }

  void baseline(const std::string& pointer, const Json& json, const Column* column) {
    if (json == "unchanged") {
      if (column && comparison_of(*column) != Comparison::value)
        at_value(pointer,
                 fmt::format("the column \"{}\" is not compared with accepted tables", column->name));
      return;
    }
    if (!json.is_object()) {
      found(pointer, json, "\"unchanged\" or an object {...}");
      return;
    }
    unknown_keys(pointer, json, kBaselineKeys);
    const bool worse = json.contains("worse_by_at_most"), differs = json.contains("differs_by_at_most");
    if (worse == differs)
      at_value(pointer, "expected one of \"worse_by_at_most\" and \"differs_by_at_most\"");
    for (const char* key : {"worse_by_at_most", "differs_by_at_most"}) {
      if (json.contains(key) && !(json[key].is_number() && json[key].get<double>() >= 0.0))
        found(child_pointer(pointer, key), json[key], "a number of at least 0");
    }
    if (json.contains("relative") && !json["relative"].is_boolean())
      found(child_pointer(pointer, "relative"), json["relative"], "true or false");
    direction(pointer, json, column);
  }

  void direction(const std::string& pointer, const Json& json, const Column* column) {
    if (json.contains("better")) {
      const std::string place = child_pointer(pointer, "better");
      if (json["better"] != "lower" && json["better"] != "higher")
        found(place, json["better"], "\"lower\" or \"higher\"");
      if (!json.contains("worse_by_at_most")) at_value(place, "it goes with \"worse_by_at_most\" only");
    } else if (json.contains("worse_by_at_most") && column && column->better == Better::none) {
      at_value(pointer,
               fmt::format("which way \"{}\" gets worse is not declared; state \"better\": \"lower\" or "
                           "\"higher\", or use \"differs_by_at_most\"",
                           column->name));
    }
  }

  void repeated_names(const std::string& pointer, const Json& list) {
    std::map<std::string, size_t> first;
    const std::vector<Gate> gates = gates_from(list, experiment_);
    for (size_t i = 0; i < gates.size(); ++i) {
      const auto [other, fresh] = first.emplace(gates[i].name, i);
      if (!fresh) {
        at_value(child_pointer(pointer, i),
                 fmt::format("the gate \"{}\" stands twice; its first place is {}", gates[i].name,
                             source_.place(child_pointer(pointer, other->second))));
      }
    }
  }

  const JsonSource& source_;
  const Experiment& experiment_;
  std::vector<Problem> problems_;
};

BaselineBound baseline_from(const Json& json, const Column* column) {
  BaselineBound bound;
  if (json == "unchanged") return bound;
  const bool worse = json.contains("worse_by_at_most");
  bound.rule = worse ? BaselineRule::not_worse : BaselineRule::near;
  bound.allowed = json[worse ? "worse_by_at_most" : "differs_by_at_most"];
  bound.relative = json.value("relative", false);
  bound.better = column->better;
  if (json.contains("better")) bound.better = json["better"] == "higher" ? Better::higher : Better::lower;
  return bound;
}

Gate gate_from(const Json& json, const Experiment& experiment) {
  Gate gate;
  gate.column = find_column(experiment, json["column"].get<std::string>());
  if (json.contains("min")) gate.min = json["min"].get<double>();
  if (json.contains("max")) gate.max = json["max"].get<double>();
  if (json.contains("baseline")) gate.baseline = baseline_from(json["baseline"], gate.column);
  if (json.contains("where")) {
    for (const auto& [name, values] : json["where"].items()) {
      GateFilter filter{find_column(experiment, name), {}};
      for (const Json& value : values.is_array() ? values : Json::array({values}))
        filter.values.push_back(scalar_value(value));
      gate.where.push_back(std::move(filter));
    }
  }
  gate.reason = json.value("reason", "");
  gate.expected_failure = json.value("expected_failure", "");
  gate.name = json.contains("name") ? json["name"].get<std::string>() : gate_words(gate);
  return gate;
}

}  // namespace

std::vector<Problem> gate_problems(const JsonSource& source, const std::string& pointer,
                                   const Experiment& experiment) {
  return Checker(source, experiment).run(pointer);
}

std::vector<Gate> gates_from(const nlohmann::ordered_json& list, const Experiment& experiment) {
  std::vector<Gate> gates;
  for (const Json& json : list) gates.push_back(gate_from(json, experiment));
  return gates;
}

bool is_gateable(const Column& column) {
  return column.kind != ColumnKind::key && (column.kind != ColumnKind::time || column.unit == "1");
}

bool is_filter(const Column& column) {
  return column.kind == ColumnKind::key || column.kind == ColumnKind::count;
}

}  // namespace hybray
