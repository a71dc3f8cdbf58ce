#include "harness/config/config_check.h"

#include "core/base/error.h"
#include "harness/config/json_value.h"
#include "harness/config/parameter_rules.h"
#include "harness/config/range.h"
#include "harness/config/schema.h"
#include "harness/gate/gate_rules.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> kKeys = {"$schema", "experiment",      "title",  "text",
                                        "seed",    "parameters",      "points", "sweep",
                                        "scenes",  "optional_scenes", "gates"};

// Collects the problems of one document.
class Checker {
 public:
  Checker(const JsonSource& source, const Experiment& experiment)
      : source_(source), experiment_(experiment) {}

  std::vector<Problem> run() {
    const Json& root = source_.root();
    for (const auto& [key, value] : root.items()) {
      const std::string pointer = child_pointer("", key);
      if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
        at_key(pointer, unknown_name("key", key, kKeys));
      } else if (key == "parameters") {
        parameters(pointer, value);
      } else if (key == "sweep") {
        sweep(pointer, value);
      } else if (key == "points") {
        points(pointer, value);
      } else if (key == "scenes") {
        scene_overrides(pointer, value);
      } else if (key == "seed") {
        seed(pointer, value);
      } else if (key == "optional_scenes") {
        optional_scenes(pointer, value);
      } else if (key == "gates") {
        const std::vector<Problem> found = gate_problems(source_, pointer, experiment_);
        problems_.insert(problems_.end(), found.begin(), found.end());
      } else if (!value.is_string()) {
        at_value(pointer, fmt::format("found {}; expected text", found_text(value)));
      }
    }
    return std::move(problems_);
  }

 private:
  void at_value(const std::string& pointer, const std::string& message) {
    problems_.push_back({source_.place(pointer), message});
  }
  void at_key(const std::string& pointer, const std::string& message) {
    problems_.push_back({source_.key_place(pointer), message});
  }

  void seed(const std::string& pointer, const Json& value) {
    constexpr int64_t kLargest = int64_t{1} << 53;
    if (!value.is_number_unsigned() || value.get<uint64_t>() >= kLargest) {
      at_value(pointer,
               fmt::format("found {}; expected an integer from 0 to {}", found_text(value), kLargest - 1));
    }
  }

  // Calls visit(pointer, parameter, value) for each member of an object of parameters; unknown names are
  // problems.
  template <class Visit>
  void members(const std::string& pointer, const Json& object, const Visit& visit) {
    if (!object.is_object()) {
      at_value(pointer, fmt::format("found {}; expected an object {{...}}", found_text(object)));
      return;
    }
    for (const auto& [name, value] : object.items()) {
      const std::string member = child_pointer(pointer, name);
      const Parameter* parameter = find_parameter(experiment_, name);
      if (parameter)
        visit(member, *parameter, value);
      else
        at_key(member, unknown_parameter(experiment_, name));
    }
  }

  void parameters(const std::string& pointer, const Json& object) {
    members(pointer, object, [&](const std::string& member, const Parameter& p, const Json& value) {
      single_value(member, p, value);
      if (every_point_gives(p.name)) {
        at_key(
            member,
            fmt::format("every point of \"points\" gives the parameter \"{}\", so this would have no effect",
                        p.name));
      }
    });
  }

  // A value where several are a likely mistake; monostate where it is not accepted.
  Value single_value(const std::string& pointer, const Parameter& p, const Json& value) {
    if (!value.is_array() && !value.is_object()) return one_value(pointer, p, value);
    at_value(pointer, fmt::format("found {}; expected {}; a {} of values belongs in \"sweep\"",
                                  found_text(value), expectation(p), value.is_array() ? "list" : "range"));
    return {};
  }

  void points(const std::string& pointer, const Json& list) {
    if (!list.is_array() || list.empty()) {
      at_value(pointer, fmt::format("found {}; expected a list [...] of objects {{...}}, each with the "
                                    "parameters of a point",
                                    list.is_array() ? "an empty list" : found_text(list)));
      return;
    }
    std::map<std::map<std::string, Value>, size_t> before;  // index by point
    for (size_t i = 0; i < list.size(); ++i) {
      const std::string item = child_pointer(pointer, i);
      const size_t known_problems = problems_.size();
      std::map<std::string, Value> point;
      members(item, list[i], [&](const std::string& member, const Parameter& p, const Json& value) {
        point[p.name] = single_value(member, p, value);
        refuse_swept(member, p);
      });
      if (problems_.size() > known_problems) continue;
      const auto [same, is_new] = before.emplace(point, i);
      if (!is_new) {
        at_value(item, fmt::format("this point stands in the list before, at {}",
                                   source_.place(child_pointer(pointer, same->second))));
      }
    }
  }

  void scene_overrides(const std::string& pointer, const Json& scenes) {
    const std::vector<std::string> known = scenes_of_config();
    if (!parameter_of_type(experiment_, ParameterType::scene)) {
      at_key(pointer, fmt::format("the experiment \"{}\" has no scenes", experiment_.name));
    } else if (!scenes.is_object()) {
      at_value(pointer, fmt::format("found {}; expected an object {{...}} with a scene's name for each key",
                                    found_text(scenes)));
    } else {
      for (const auto& [scene, object] : scenes.items()) {
        const std::string member = child_pointer(pointer, scene);
        if (std::find(known.begin(), known.end(), scene) == known.end()) {
          at_key(member, fmt::format("{} is not among the scenes of this config{}", json_text(scene),
                                     suggestion(scene, known)));
        }
        members(member, object, [&](const std::string& place, const Parameter& p, const Json& value) {
          scene_override(place, p, value);
        });
      }
    }
  }

  void scene_override(const std::string& pointer, const Parameter& p, const Json& value) {
    if (p.type == ParameterType::scene) {
      at_key(pointer, "the scene is named by the key of these parameters already");
      return;
    }
    single_value(pointer, p, value);
    refuse_swept(pointer, p);
    if (every_point_gives(p.name)) {
      at_key(pointer,
             fmt::format("every point of \"points\" gives the parameter \"{}\", so this would have no effect",
                         p.name));
    }
  }

  void refuse_swept(const std::string& pointer, const Parameter& p) {
    const Json::json_pointer swept("/sweep/" + p.name);
    if (!source_.root().contains(swept)) return;
    at_key(pointer, fmt::format("the parameter \"{}\" stands in \"sweep\" too, at {}", p.name,
                                source_.key_place("/sweep/" + p.name)));
  }

  bool every_point_gives(const std::string& name) const {
    const auto points = source_.root().find("points");
    return points != source_.root().end() && points->is_array() && !points->empty() &&
           std::all_of(points->begin(), points->end(),
                       [&](const Json& point) { return point.is_object() && point.contains(name); });
  }

  void sweep(const std::string& pointer, const Json& object) {
    members(pointer, object, [&](const std::string& member, const Parameter& p, const Json& values) {
      const Json& root = source_.root();
      if (root.contains("parameters") && root["parameters"].is_object() &&
          root["parameters"].contains(p.name)) {
        at_key(member, fmt::format("the parameter \"{}\" stands in \"parameters\" too, at {}", p.name,
                                   source_.key_place("/parameters/" + p.name)));
      }
      if (values.is_object() && takes_range(p)) {
        range(member, p, values);
        return;
      }
      if (!values.is_array()) {
        at_value(member, fmt::format("found {}; expected a list [...] of values{}; a single value belongs in "
                                     "\"parameters\"",
                                     found_text(values), takes_range(p) ? " or a range {...}" : ""));
        return;
      }
      if (values.empty()) at_value(member, "found an empty list; expected at least one value");
      std::vector<Value> before;
      for (size_t i = 0; i < values.size(); ++i) list_value(child_pointer(member, i), p, values, i, before);
    });
  }

  void range(const std::string& pointer, const Parameter& p, const Json& range) {
    std::vector<RangeProblem> problems;
    range_values(p, range, problems);
    for (const RangeProblem& problem : problems) {
      const std::string place = problem.member.empty() ? pointer : child_pointer(pointer, problem.member);
      if (problem.at_key)
        at_key(place, problem.message);
      else
        at_value(place, problem.message);
    }
  }

  void list_value(const std::string& pointer, const Parameter& p, const Json& list, size_t i,
                  std::vector<Value>& before) {
    const size_t known_problems = problems_.size();
    const Value value = one_value(pointer, p, list[i]);
    if (problems_.size() > known_problems) return;
    if (std::find(before.begin(), before.end(), value) != before.end()) {
      at_value(pointer, fmt::format("the value {} stands twice in this list", json_text(value)));
    }
    const std::string star = star_problem(p, value, list.size());
    if (!star.empty()) at_value(pointer, star);
    before.push_back(value);
  }

  Value one_value(const std::string& pointer, const Parameter& p, const Json& json) {
    Value value = scalar_value(json);
    if (!accept(p, value)) at_value(pointer, rejection(p, found_text(json), value));
    return value;
  }

  void optional_scenes(const std::string& pointer, const Json& list) {
    if (!list.is_array()) {
      at_value(pointer, fmt::format("found {}; expected a list [...] of scene names", found_text(list)));
      return;
    }
    const std::vector<std::string> scenes = scenes_of_config();
    for (size_t i = 0; i < list.size(); ++i) {
      const std::string item = child_pointer(pointer, i);
      if (!list[i].is_string()) {
        at_value(item, fmt::format("found {}; expected the name of a scene", found_text(list[i])));
      } else if (std::find(scenes.begin(), scenes.end(), list[i].get_ref<const std::string&>()) ==
                 scenes.end()) {
        at_value(item, fmt::format("{} is not among the scenes of this config", found_text(list[i])));
      } else if (std::find(list.begin(), list.begin() + i, list[i]) != list.begin() + i) {
        at_value(item, fmt::format("the value {} stands twice in this list", found_text(list[i])));
      }
    }
  }

  std::vector<std::string> scenes_of_config() const {
    std::vector<std::string> scenes;
    const Parameter* scene = parameter_of_type(experiment_, ParameterType::scene);
    if (!scene) return scenes;
    const auto add = [&](const Json& object) {
      if (!object.is_object() || !object.contains(scene->name)) return;
      const Json& value = object[scene->name];
      for (const Json& name : value.is_array() ? value : Json::array({value})) {
        if (name.is_string()) scenes.push_back(name);
      }
    };
    const Json& root = source_.root();
    for (const char* part : {"parameters", "sweep"})
      if (root.contains(part)) add(root[part]);
    if (root.contains("points") && root["points"].is_array())
      std::for_each(root["points"].begin(), root["points"].end(), add);
    return scenes;
  }

  const JsonSource& source_;
  const Experiment& experiment_;
  std::vector<Problem> problems_;
};

}  // namespace

const Experiment& experiment_of(const JsonSource& source, std::span<const Experiment> experiments) {
  const Json& root = source.root();
  if (!root.is_object()) {
    throw InputError(source.place(""), fmt::format("found {}; expected an object {{...}}", found_text(root)));
  }
  if (!root.contains("experiment")) {
    throw InputError(source.place(""), "the key \"experiment\" is missing: it names the experiment to run");
  }
  const Json& name = root["experiment"];
  const std::string place = source.place("/experiment");
  if (!name.is_string())
    throw InputError(place, fmt::format("found {}; expected the name of an experiment", found_text(name)));
  if (const Experiment* found = find_experiment(name, experiments)) return *found;
  throw InputError(place, unknown_experiment(name, experiments));
}

std::vector<Problem> config_problems(const JsonSource& source, const Experiment& experiment) {
  std::vector<Problem> problems = Checker(source, experiment).run();
  if (!problems.empty()) return problems;
  for (const SchemaViolation& violation : schema_violations(config_schema(experiment), source.root())) {
    problems.push_back({source.place(violation.pointer), violation.message});
  }
  return problems;
}

void throw_problems(const std::vector<Problem>& problems) {
  if (problems.empty()) return;
  std::string message = problems.front().message;
  for (size_t i = 1; i < problems.size(); ++i)
    message += '\n' + problems[i].place + ": " + problems[i].message;
  throw InputError(problems.front().place, message);
}

}  // namespace hybray
