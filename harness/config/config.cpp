#include "harness/config/config.h"

#include "core/base/check.h"
#include "core/base/error.h"
#include "harness/config/config_check.h"
#include "harness/config/json_value.h"
#include "harness/config/parameter_rules.h"
#include "harness/config/range.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

// Everything that the functions below read is checked already (config_check.h).

Given given_at(const JsonSource& source, const std::string& pointer, const Parameter& parameter,
               const Json& json) {
  Value value = scalar_value(json);
  HYBRAY_CHECK(accept(parameter, value));
  return {&parameter, value, source.place(pointer)};
}

// An object of parameters with one value each.
GivenSet set_from(const JsonSource& source, const std::string& pointer, const Json& object,
                  const Experiment& experiment) {
  GivenSet set;
  for (const auto& [name, value] : object.items())
    set.push_back(given_at(source, child_pointer(pointer, name), *find_parameter(experiment, name), value));
  return set;
}

// A list or a range of "sweep".
Setting swept_from(const JsonSource& source, const std::string& pointer, const Parameter& parameter,
                   const Json& json) {
  Setting setting{&parameter, {}, {}};
  if (json.is_object()) {
    std::vector<RangeProblem> problems;
    setting.values = range_values(parameter, json, problems);
    HYBRAY_CHECK(problems.empty());
    setting.places.assign(setting.values.size(), source.place(pointer));
  }
  for (size_t i = 0; json.is_array() && i < json.size(); ++i) {
    const Given given = given_at(source, child_pointer(pointer, i), parameter, json[i]);
    setting.values.push_back(given.value);
    setting.places.push_back(given.place);
  }
  return setting;
}

void erase_given(GivenSet& set, const Parameter* parameter) {
  std::erase_if(set, [&](const Given& given) { return given.parameter == parameter; });
}

// Whether two sets give the same values to the same parameters, in whatever order.
bool equal(const GivenSet& a, const GivenSet& b) {
  return a.size() == b.size() && std::all_of(a.begin(), a.end(), [&](const Given& given) {
           const Given* other = find_given(b, given.parameter);
           return other && other->value == given.value;
         });
}

// Takes the parameter out of the listed points; of those that are then equal one stays.
void erase_from_points(Config& config, const Parameter* parameter) {
  std::vector<GivenSet> kept;
  for (GivenSet& point : config.points) {
    if (find_given(point, parameter)) config.merge_equal_points = true;
    erase_given(point, parameter);
    if (std::none_of(kept.begin(), kept.end(), [&](const GivenSet& k) { return equal(k, point); }))
      kept.push_back(std::move(point));
  }
  config.points = std::move(kept);
}

void assign(Config& config, GivenSet& parameters, const Assignment& assignment) {
  const std::string& place = assignment.place;
  if (assignment.key == "seed") {
    const Parameter seed{"seed", ParameterType::integer, "", {}, 0.0, 9007199254740991.0, {}, ""};
    config.seed = std::get<int64_t>(value_from_text(seed, assignment.text, place));
    return;
  }
  const Parameter* parameter = find_parameter(*config.experiment, assignment.key);
  if (!parameter) throw InputError(place, unknown_parameter(*config.experiment, assignment.key));
  const std::vector<Value> values = values_of(assignment, *parameter);
  for (const Value& value : values) {
    const std::string star = star_problem(*parameter, value, values.size());
    if (!star.empty()) throw InputError(place, star);
  }

  erase_from_points(config, parameter);
  for (auto& [scene, set] : config.scene_overrides) erase_given(set, parameter);
  erase_given(parameters, parameter);
  const auto swept = std::find_if(config.sweep.begin(), config.sweep.end(),
                                  [&](const Setting& s) { return s.parameter == parameter; });
  const bool was_swept = swept != config.sweep.end();
  if (values.size() == 1) {
    if (was_swept) config.sweep.erase(swept);
    parameters.push_back({parameter, values.front(), place});
    return;
  }
  Setting setting{parameter, values, std::vector<std::string>(values.size(), place)};
  if (was_swept)
    *swept = std::move(setting);
  else
    config.sweep.push_back(std::move(setting));
}

// The scenes of points that name none themselves: those of the sweep, or the fixed one.
std::vector<Given> base_scenes(const Config& config) {
  std::vector<Given> scenes;
  for (const auto* settings : {&config.sweep, &config.fixed}) {
    for (const Setting& s : *settings) {
      if (s.parameter->type != ParameterType::scene) continue;
      for (size_t i = 0; i < s.values.size(); ++i) scenes.push_back({s.parameter, s.values[i], s.places[i]});
    }
  }
  return scenes;
}

// Whether each point gets the parameter from the list of points or from its scene's override.
bool given_elsewhere(const Config& config, const Parameter* parameter) {
  const Parameter* scene_parameter = parameter_of_type(*config.experiment, ParameterType::scene);
  const auto override_gives = [&](const Given& scene) {
    const auto found = config.scene_overrides.find(std::get<std::string>(scene.value));
    return found != config.scene_overrides.end() && find_given(found->second, parameter);
  };
  const std::vector<Given> base = base_scenes(config);
  const bool bases_give = !base.empty() && std::all_of(base.begin(), base.end(), override_gives);
  if (config.points.empty()) return bases_give;
  return std::all_of(config.points.begin(), config.points.end(), [&](const GivenSet& point) {
    const Given* own = scene_parameter ? find_given(point, scene_parameter) : nullptr;
    return find_given(point, parameter) || (own ? override_gives(*own) : bases_give);
  });
}

// Every parameter that is not swept, in declared order: as given, else its default.
void complete(Config& config, const GivenSet& parameters, const std::string& document_place) {
  std::vector<const Parameter*> without;
  for (const Parameter& parameter : config.experiment->parameters) {
    if (std::any_of(config.sweep.begin(), config.sweep.end(),
                    [&](const Setting& s) { return s.parameter == &parameter; }))
      continue;
    if (const Given* given = find_given(parameters, &parameter)) {
      config.fixed.push_back({&parameter, {given->value}, {given->place}});
    } else if (!std::holds_alternative<std::monostate>(parameter.default_value)) {
      config.fixed.push_back({&parameter,
                              {parameter.default_value},
                              {fmt::format("{} (default of \"{}\")", config.file.string(), parameter.name)}});
    } else {
      without.push_back(&parameter);
    }
  }
  std::vector<Problem> missing;
  for (const Parameter* parameter : without) {
    if (given_elsewhere(config, parameter)) continue;
    missing.push_back(
        {document_place,
         fmt::format("the parameter \"{}\" has no default: \"parameters\" or \"sweep\" must give it ({})",
                     parameter->name, expectation(*parameter))});
  }
  throw_problems(missing);
}

}  // namespace

const Setting& Config::setting(const std::string& wanted) const {
  const Setting* found = nullptr;
  for (const auto* settings : {&sweep, &fixed}) {
    for (const Setting& setting : *settings) {
      if (setting.parameter->name == wanted) found = &setting;
    }
  }
  HYBRAY_CHECK(found != nullptr);
  return *found;
}

const Given* find_given(const GivenSet& set, const Parameter* parameter) {
  for (const Given& given : set) {
    if (given.parameter == parameter) return &given;
  }
  return nullptr;
}

std::vector<const Parameter*> varied_parameters(const Config& config) {
  std::vector<const Parameter*> varied;
  const auto add = [&](const Parameter* parameter) {
    if (std::find(varied.begin(), varied.end(), parameter) == varied.end()) varied.push_back(parameter);
  };
  const auto add_every_camera = [&](const Given& given) {
    if (stands_for_cameras(*given.parameter, given.value)) add(given.parameter);
  };
  for (const GivenSet& point : config.points) {
    for (const Given& given : point) add(given.parameter);
  }
  for (const Setting& setting : config.sweep) add(setting.parameter);
  for (const auto& [scene, set] : config.scene_overrides) {
    for (const Given& given : set) add_every_camera(given);
  }
  for (const Setting& setting : config.fixed)
    add_every_camera({setting.parameter, setting.values.front(), ""});
  return varied;
}

std::vector<Given> scenes_of(const Config& config) {
  const std::vector<Given> base = base_scenes(config);
  if (config.points.empty()) return base;
  const Parameter* scene = parameter_of_type(*config.experiment, ParameterType::scene);
  std::vector<Given> scenes;
  const auto add = [&](const Given& given) {
    if (std::none_of(scenes.begin(), scenes.end(), [&](const Given& g) { return g.value == given.value; }))
      scenes.push_back(given);
  };
  for (const GivenSet& point : config.points) {
    if (const Given* own = scene ? find_given(point, scene) : nullptr)
      add(*own);
    else
      std::for_each(base.begin(), base.end(), add);
  }
  return scenes;
}

Config load_config(const JsonSource& source, const std::filesystem::path& file,
                   std::span<const Experiment> experiments, std::span<const Assignment> assignments) {
  Config config;
  config.file = file;
  config.name = file.stem().string();
  config.experiment = &experiment_of(source, experiments);
  throw_problems(config_problems(source, *config.experiment));

  const Json& root = source.root();
  config.title = root.value("title", "");
  config.text = root.value("text", "");
  config.seed = root.value("seed", int64_t{1});
  config.optional_scenes = root.value("optional_scenes", std::vector<std::string>{});
  const Json none = Json::object();
  const Json& sweep = root.contains("sweep") ? root["sweep"] : none;
  for (const auto& [name, values] : sweep.items()) {
    config.sweep.push_back(
        swept_from(source, child_pointer("/sweep", name), *find_parameter(*config.experiment, name), values));
  }
  const Json& points = root.contains("points") ? root["points"] : none;
  for (size_t i = 0; i < points.size(); ++i) {
    config.points.push_back(set_from(source, child_pointer("/points", i), points[i], *config.experiment));
  }
  const Json& scenes = root.contains("scenes") ? root["scenes"] : none;
  for (const auto& [scene, object] : scenes.items()) {
    config.scene_overrides[scene] =
        set_from(source, child_pointer("/scenes", scene), object, *config.experiment);
  }
  GivenSet parameters;
  if (root.contains("parameters"))
    parameters = set_from(source, "/parameters", root["parameters"], *config.experiment);
  for (const Assignment& assignment : assignments) assign(config, parameters, assignment);
  complete(config, parameters, source.place(""));
  return config;
}

Config load_config(const std::filesystem::path& file, std::span<const Experiment> experiments,
                   std::span<const Assignment> assignments) {
  return load_config(JsonSource::read(file), file, experiments, assignments);
}

}  // namespace hybray
