#include "harness/sweep/freeze.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/tracer/seeded_camera.h"
#include "harness/config/json_value.h"
#include "harness/config/parameter_rules.h"
#include "harness/sweep/axes.h"
#include "harness/sweep/memory.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

constexpr double kMostPoints = 100'000;

using Parameters = std::map<std::string, Value>;

// What points must match, by parameter.
class Filters {
 public:
  Filters(const Experiment& experiment, const std::vector<Assignment>& filters) {
    for (const Assignment& filter : filters) {
      const Parameter* parameter = find_parameter(experiment, filter.key);
      if (!parameter) throw InputError(filter.place, unknown_parameter(experiment, filter.key));
      std::vector<Value>& wanted = wanted_[parameter];
      for (const Value& value : values_of(filter, *parameter)) {
        const std::vector<Value> values = expanded(*parameter, value);
        wanted.insert(wanted.end(), values.begin(), values.end());
      }
    }
  }

  // Whether the filters let these values pass; "*" passes, since it is not known yet what it stands for.
  bool pass(const Combination& combination) const {
    return std::all_of(wanted_.begin(), wanted_.end(), [&](const auto& wanted) {
      const auto& [parameter, values] = wanted;
      const Value& value = combination.at(parameter->name)->value;
      return stands_for_every_camera(*parameter, value) ||
             std::find(values.begin(), values.end(), value) != values.end();
    });
  }

 private:
  std::map<const Parameter*, std::vector<Value>> wanted_;
};

// Freezes one config; a class only to share what all steps look at.
class Freezer {
 public:
  Freezer(const Config& config, SceneCatalog& catalog, const FreezeOptions& options)
      : config_(config),
        catalog_(catalog),
        options_(options),
        filters_(*config.experiment, options.filters),
        suite_filters_(*config.experiment, options.suite_filters),
        scene_(parameter_of_type(*config.experiment, ParameterType::scene)),
        camera_(parameter_of_type(*config.experiment, ParameterType::camera)) {}

  FrozenSweep run() {
    check_count();
    if (!scene_) {
      const std::vector<Axis> axes = axes_of(config_, nullptr);
      check_memory(axes);
      freeze_combinations(axes, 0);
    } else {
      const std::vector<Given> scenes = scenes_to_run();
      for (const Given& scene : scenes) check_memory(axes_of(config_, &scene));
      for (const Given& scene : scenes) freeze_scene(scene);
    }
    if (sweep_.points.empty() && sweep_.skipped.empty() && !options_.may_be_empty) {
      const auto& filters = options_.filters.empty() ? options_.suite_filters : options_.filters;
      throw InputError(filters.front().place, "no point of " + config_.file.string() + " matches");
    }
    return std::move(sweep_);
  }

 private:
  static const std::string& text(const Value& value) { return std::get<std::string>(value); }

  bool pass(const Combination& combination) const {
    return filters_.pass(combination) && suite_filters_.pass(combination);
  }

  void check_count() const {
    double count = scene_ ? 0 : combination_count(axes_of(config_, nullptr));
    for (const Given& scene : scenes_of(config_)) count += combination_count(axes_of(config_, &scene));
    if (count <= kMostPoints) return;
    throw InputError(config_.file.string(),
                     fmt::format("it has {:.0f} points; expected at most {:.0f}", count, kMostPoints));
  }

  // All scenes but those that no filter lets pass, and optional ones whose source is missing; any other
  // missing one is an error.
  std::vector<Given> scenes_to_run() {
    std::vector<Given> kept;
    for (const Given& scene : scenes_of(config_)) {
      const std::string& name = text(scene.value);
      SkippedScene skipped{name, 0, false};
      for_each_combination(axes_of(config_, &scene), [&](const Combination& combination) {
        if (!pass(combination)) return;
        ++skipped.points;
        if (camera_ && stands_for_every_camera(*camera_, combination.at(camera_->name)->value))
          skipped.for_each_camera = true;
      });
      if (skipped.points == 0) continue;
      const auto& optional = config_.optional_scenes;
      const SceneState state = catalog_.state(name);
      if (state == SceneState::source_missing &&
          std::find(optional.begin(), optional.end(), name) != optional.end()) {
        sweep_.skipped.push_back(skipped);
        continue;
      }
      if (state != SceneState::available) catalog_.facts(name, scene.place);  // throws the library's message
      kept.push_back(scene);
    }
    return kept;
  }

  void check_memory(const std::vector<Axis>& axes) const {
    if (!config_.experiment->memory_bytes) return;
    const Parameter* resolution = parameter_of_type(*config_.experiment, ParameterType::resolution);
    for_each_combination(axes, [&](const Combination& combination) {
      if (!pass(combination)) return;
      const double needed = config_.experiment->memory_bytes({"", values_of(combination)});
      if (needed <= options_.memory_bytes) return;
      const Given* size = resolution ? combination.at(resolution->name) : nullptr;
      throw InputError(size ? size->place : config_.file.string(),
                       fmt::format("{} needs about {} of memory; {} are available",
                                   size ? "the resolution " + json_text(size->value) : "a point",
                                   format_bytes(needed), format_bytes(options_.memory_bytes)));
    });
  }

  void freeze_scene(const Given& scene) {
    const std::string& name = text(scene.value);
    const SceneFacts& facts = catalog_.facts(name, scene.place);
    std::vector<Axis> axes = axes_of(config_, &scene);
    check_cameras(axes, name, facts);
    expand_cameras(axes, facts.cameras);
    freeze_combinations(axes, facts.content_hash);
    sweep_.scenes[name] = facts;
  }

  void check_cameras(const std::vector<Axis>& axes, const std::string& scene, const SceneFacts& facts) const {
    for (const Axis& axis : axes) {
      for (const GivenSet& entry : axis) {
        const Given* camera = camera_ ? find_given(entry, camera_) : nullptr;
        if (!camera) continue;
        const bool star = stands_for_every_camera(*camera_, camera->value);
        if (star && facts.cameras.empty()) {
          throw InputError(camera->place,
                           fmt::format("\"*\" stands for no camera: the scene \"{}\" has none", scene));
        }
        const std::string& name = text(camera->value);
        if (star || seeded_camera_number(name) ||
            std::find(facts.cameras.begin(), facts.cameras.end(), name) != facts.cameras.end())
          continue;
        throw InputError(camera->place, fmt::format("the scene \"{}\" has no camera {}{}", scene,
                                                    json_text(name), suggestion(name, facts.cameras)));
      }
    }
  }

  void freeze_combinations(const std::vector<Axis>& axes, uint64_t scene_hash) {
    for_each_combination(axes, [&](const Combination& combination) {
      if (!pass(combination)) return;
      const Parameters values = values_of(combination);
      Point point{point_id(config_.experiment->name, values, config_.seed, scene_hash), values};
      if (ids_.insert(point.id).second) {
        sweep_.points.push_back(std::move(point));
      } else if (!config_.merge_equal_points) {
        throw InputError(config_.file.string(),
                         config_.points.empty()
                             ? "two points of the sweep are the same; has a scene two cameras of one name?"
                             : "two of \"points\" are the same, with what they leave out filled in: " +
                                   label(combination));
      }
    });
  }

  // "count=2 length=1": what the listed points give.
  std::string label(const Combination& combination) const {
    std::string label;
    for (const Parameter* parameter : varied_parameters(config_)) {
      label += fmt::format("{}{}={}", label.empty() ? "" : " ", parameter->name,
                           to_text(combination.at(parameter->name)->value));
    }
    return label;
  }

  const Config& config_;
  SceneCatalog& catalog_;
  const FreezeOptions& options_;
  const Filters filters_, suite_filters_;
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
