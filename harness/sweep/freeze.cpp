#include "harness/sweep/freeze.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "harness/config/json_value.h"
#include "harness/config/parameter_rules.h"
#include "harness/sweep/memory.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

const Value kEveryCamera = std::string("*");

using Parameters = std::map<std::string, Value>;

// One parameter that varies, and the values it takes.
using Axes = std::vector<Setting>;

const Parameter* parameter_of_type(const Experiment& experiment, ParameterType type) {
  for (const Parameter& p : experiment.parameters) {
    if (p.type == type) return &p;
  }
  return nullptr;
}

// All settings as axes, slowest first: the scene, a camera that is "*" without being swept, the sweep as it
// stands, the rest.
Axes axes_of(const Config& config) {
  Axes axes;
  const auto is_late = [](const Setting& s) {
    return !(s.parameter->type == ParameterType::camera && s.values.front() == kEveryCamera);
  };
  for (const Setting& s : config.fixed) {
    if (!is_late(s)) axes.push_back(s);
  }
  axes.insert(axes.end(), config.sweep.begin(), config.sweep.end());
  for (const Setting& s : config.fixed) {
    if (is_late(s)) axes.push_back(s);
  }
  std::stable_partition(axes.begin(), axes.end(),
                        [](const Setting& s) { return s.parameter->type == ParameterType::scene; });
  return axes;
}

// Calls visit(values by name, index of each axis's value) for each combination, the last axis fastest.
template <class Visit>
void for_each_combination(const Axes& axes, const Visit& visit) {
  for (const Setting& axis : axes) {
    if (axis.values.empty()) return;
  }
  std::vector<size_t> index(axes.size(), 0);
  while (true) {
    Parameters values;
    for (size_t a = 0; a < axes.size(); ++a) values[axes[a].parameter->name] = axes[a].values[index[a]];
    visit(values, index);
    size_t a = axes.size();
    while (a > 0 && ++index[a - 1] == axes[a - 1].values.size()) index[--a] = 0;
    if (a == 0) return;
  }
}

// The `--filter` options, by parameter.
class Filters {
 public:
  Filters(const Config& config, const std::vector<std::string>& filters) {
    for (const std::string& filter : filters) {
      const std::string place = "--filter " + filter;
      const auto [key, text] = split_assignment(filter, place);
      const Parameter* parameter = find_parameter(*config.experiment, key);
      if (!parameter) throw InputError(place, unknown_parameter(*config.experiment, key));
      wanted_[key].push_back(value_from_text(*parameter, text, place));
    }
  }

  // Whether the filters let these values pass; "*" passes, since it is not known yet what it stands for.
  bool pass(const Parameters& values) const {
    return std::all_of(wanted_.begin(), wanted_.end(), [&](const auto& wanted) {
      const Value& value = values.at(wanted.first);
      const bool matches =
          std::find(wanted.second.begin(), wanted.second.end(), value) != wanted.second.end();
      return value == kEveryCamera || matches;
    });
  }

 private:
  std::map<std::string, std::vector<Value>> wanted_;
};

// Freezes one config; a class only to share what all steps look at.
class Freezer {
 public:
  Freezer(const Config& config, SceneCatalog& catalog, const FreezeOptions& options)
      : config_(config),
        catalog_(catalog),
        options_(options),
        filters_(config, options.filters),
        axes_(axes_of(config)),
        scene_(parameter_of_type(*config.experiment, ParameterType::scene)),
        camera_(parameter_of_type(*config.experiment, ParameterType::camera)) {}

  FrozenSweep run() {
    if (scene_) leave_out_missing_scenes();
    check_memory();
    if (!scene_) {
      freeze_combinations(axes_, 0);
    } else {
      const Setting scenes = axes_.front();
      for (size_t i = 0; i < scenes.values.size(); ++i) freeze_scene(scenes.values[i], scenes.places[i]);
    }
    if (sweep_.points.empty() && sweep_.skipped.empty()) {
      throw InputError("--filter " + options_.filters.front(),
                       "no point of " + config_.file.string() + " matches");
    }
    return std::move(sweep_);
  }

 private:
  static const std::string& text(const Value& value) { return std::get<std::string>(value); }

  // The axes with the scene axis, which is the first, held at one value.
  Axes axes_of_scene(const Value& scene, const std::string& place) const {
    Axes axes = axes_;
    axes.front().values = {scene};
    axes.front().places = {place};
    return axes;
  }

  size_t count_passing(const Axes& axes) const {
    size_t count = 0;
    for_each_combination(axes,
                         [&](const Parameters& values, const auto&) { count += filters_.pass(values); });
    return count;
  }

  // Takes out scenes that no filter lets pass, then optional ones whose source is missing; any other missing
  // one is an error.
  void leave_out_missing_scenes() {
    Setting& scenes = axes_.front();
    Setting kept{scenes.parameter, {}, {}};
    for (size_t i = 0; i < scenes.values.size(); ++i) {
      const std::string& name = text(scenes.values[i]);
      const size_t points = count_passing(axes_of_scene(scenes.values[i], scenes.places[i]));
      if (points == 0) continue;
      const auto& optional = config_.optional_scenes;
      const SceneState state = catalog_.state(name);
      if (state == SceneState::source_missing &&
          std::find(optional.begin(), optional.end(), name) != optional.end()) {
        const bool each = camera_ && config_.setting(camera_->name).values.front() == kEveryCamera;
        sweep_.skipped.push_back({name, points, each});
        continue;
      }
      if (state != SceneState::available)
        catalog_.facts(name, scenes.places[i]);  // throws the library's message
      kept.values.push_back(scenes.values[i]);
      kept.places.push_back(scenes.places[i]);
    }
    scenes = kept;
  }

  void check_memory() const {
    if (!config_.experiment->memory_bytes) return;
    const Parameter* resolution = parameter_of_type(*config_.experiment, ParameterType::resolution);
    for_each_combination(axes_, [&](const Parameters& values, const std::vector<size_t>& index) {
      if (!filters_.pass(values)) return;
      const double needed = config_.experiment->memory_bytes({"", values});
      if (needed <= options_.memory_bytes) return;
      std::string place = config_.file.string();
      for (size_t a = 0; a < axes_.size(); ++a) {
        if (axes_[a].parameter == resolution) place = axes_[a].places[index[a]];
      }
      const std::string what =
          resolution ? "the resolution " + json_text(values.at(resolution->name)) : "a point";
      throw InputError(place, fmt::format("{} needs about {} of memory; {} are available", what,
                                          format_bytes(needed), format_bytes(options_.memory_bytes)));
    });
  }

  void freeze_scene(const Value& scene, const std::string& place) {
    const SceneFacts& facts = catalog_.facts(text(scene), place);
    Axes axes = axes_of_scene(scene, place);
    if (camera_) expand_cameras(axes, text(scene), facts);
    freeze_combinations(axes, facts.content_hash);
    sweep_.scenes[text(scene)] = facts;
  }

  void expand_cameras(Axes& axes, const std::string& scene, const SceneFacts& facts) const {
    for (Setting& axis : axes) {
      if (axis.parameter != camera_) continue;
      if (axis.values.front() == kEveryCamera) {
        if (facts.cameras.empty()) {
          throw InputError(axis.places.front(),
                           fmt::format("\"*\" stands for no camera: the scene \"{}\" has none", scene));
        }
        axis.places.assign(facts.cameras.size(), axis.places.front());
        axis.values.assign(facts.cameras.begin(), facts.cameras.end());
      }
      for (size_t i = 0; i < axis.values.size(); ++i) {
        const std::string& name = text(axis.values[i]);
        if (std::find(facts.cameras.begin(), facts.cameras.end(), name) != facts.cameras.end()) continue;
        throw InputError(axis.places[i],
                         fmt::format("the scene \"{}\" has no camera {}{}", scene, json_text(axis.values[i]),
                                     suggestion(name, facts.cameras)));
      }
    }
  }

  void freeze_combinations(const Axes& axes, uint64_t scene_hash) {
    for_each_combination(axes, [&](const Parameters& values, const auto&) {
      if (!filters_.pass(values)) return;
      Point point{point_id(config_.experiment->name, values, config_.seed, scene_hash), values};
      if (!ids_.insert(point.id).second) {
        throw InputError(config_.file.string(),
                         "two points of the sweep are the same; has a scene two cameras of one name?");
      }
      sweep_.points.push_back(std::move(point));
    });
  }

  const Config& config_;
  SceneCatalog& catalog_;
  const FreezeOptions& options_;
  const Filters filters_;
  Axes axes_;  // the scene, where there is one, comes first
  const Parameter* scene_;
  const Parameter* camera_;
  FrozenSweep sweep_;
  std::set<std::string> ids_;  // of its points
};

}  // namespace

std::string point_id(const std::string& experiment, const Parameters& parameters, int64_t seed,
                     uint64_t scene_hash) {
  nlohmann::json canonical;  // keys sorted, so the order of the file does not matter
  canonical["experiment"] = experiment;
  canonical["seed"] = seed;
  canonical["scene"] = hex(scene_hash);
  for (const auto& [name, value] : parameters) canonical["parameters"][name] = nlohmann::json(to_json(value));
  return hex(hash_text(canonical.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)));
}

FrozenSweep freeze(const Config& config, SceneCatalog& scenes, const FreezeOptions& options) {
  return Freezer(config, scenes, options).run();
}

}  // namespace hybray
