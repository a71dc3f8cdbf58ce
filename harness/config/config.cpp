#include "harness/config/config.h"

#include "core/base/check.h"
#include "core/base/error.h"
#include "harness/config/config_check.h"
#include "harness/config/json_source.h"
#include "harness/config/json_value.h"
#include "harness/config/parameter_rules.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

// The setting of a parameter in "parameters" or "sweep", all of its values checked before.
Setting setting_from(const JsonSource& source, const std::string& pointer, const Parameter& parameter,
                     const Json& json) {
  Setting setting{&parameter, {}, {}};
  const auto add = [&](const std::string& place, const Json& scalar) {
    Value value = scalar_value(scalar);
    HYBRAY_CHECK(accept(parameter, value));
    setting.values.push_back(value);
    setting.places.push_back(source.place(place));
  };
  if (!json.is_array()) add(pointer, json);
  for (size_t i = 0; json.is_array() && i < json.size(); ++i) add(child_pointer(pointer, i), json[i]);
  return setting;
}

std::vector<Setting> settings_from(const JsonSource& source, const std::string& part,
                                   const Experiment& experiment) {
  std::vector<Setting> settings;
  const auto object = source.root().find(part);
  if (object == source.root().end()) return settings;
  for (const auto& [name, value] : object->items()) {
    const std::string pointer = child_pointer("/" + part, name);
    settings.push_back(setting_from(source, pointer, *find_parameter(experiment, name), value));
  }
  return settings;
}

Setting* find_setting(std::vector<Setting>& settings, const std::string& parameter) {
  for (Setting& setting : settings) {
    if (setting.parameter->name == parameter) return &setting;
  }
  return nullptr;
}

void assign(Config& config, std::vector<Setting>& given, const std::string& assignment) {
  const std::string place = "--set " + assignment;
  const auto [key, text] = split_assignment(assignment, place);
  if (key == "seed") {
    const Parameter seed{"seed", ParameterType::integer, "", {}, 0.0, 9007199254740991.0, {}, ""};
    config.seed = std::get<int64_t>(value_from_text(seed, text, place));
    return;
  }
  const Parameter* parameter = find_parameter(*config.experiment, key);
  if (!parameter) throw InputError(place, unknown_parameter(*config.experiment, key));
  const Setting setting{parameter, {value_from_text(*parameter, text, place)}, {place}};
  std::erase_if(config.sweep, [&](const Setting& s) { return s.parameter == parameter; });
  if (Setting* old = find_setting(given, key))
    *old = setting;
  else
    given.push_back(setting);
}

// Every parameter that is not swept, in declared order: as given, else its default.
std::vector<Setting> complete(Config& config, std::vector<Setting>& given,
                              const std::string& document_place) {
  std::vector<Setting> fixed;
  std::vector<Problem> missing;
  for (const Parameter& parameter : config.experiment->parameters) {
    if (find_setting(config.sweep, parameter.name)) continue;
    if (const Setting* setting = find_setting(given, parameter.name)) {
      fixed.push_back(*setting);
    } else if (!std::holds_alternative<std::monostate>(parameter.default_value)) {
      fixed.push_back({&parameter,
                       {parameter.default_value},
                       {fmt::format("{} (default of \"{}\")", config.file.string(), parameter.name)}});
    } else {
      missing.push_back(
          {document_place,
           fmt::format("the parameter \"{}\" has no default: \"parameters\" or \"sweep\" must give it ({})",
                       parameter.name, expectation(parameter))});
    }
  }
  throw_problems(missing);
  return fixed;
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

std::pair<std::string, std::string> split_assignment(const std::string& assignment,
                                                     const std::string& place) {
  const size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) throw InputError(place, "expected KEY=VALUE");
  return {assignment.substr(0, equals), assignment.substr(equals + 1)};
}

Config load_config(const std::filesystem::path& file, std::span<const Experiment> experiments,
                   std::span<const std::string> assignments) {
  const JsonSource source = JsonSource::read(file);
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
  config.sweep = settings_from(source, "sweep", *config.experiment);
  std::vector<Setting> given = settings_from(source, "parameters", *config.experiment);
  for (const std::string& assignment : assignments) assign(config, given, assignment);
  config.fixed = complete(config, given, source.place(""));
  return config;
}

}  // namespace hybray
