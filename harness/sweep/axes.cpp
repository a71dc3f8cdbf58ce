#include "harness/sweep/axes.h"

#include "harness/config/parameter_rules.h"

#include <algorithm>

namespace hybray {
namespace {

// What the points of a scene have where neither the sweep nor the list of points says otherwise.
GivenSet base_of(const Config& config, const Given* scene) {
  GivenSet base;
  const auto add = [&](const Given& given) {
    if (!find_given(base, given.parameter)) base.push_back(given);
  };
  if (scene) {
    add(*scene);
    const auto own = config.scene_overrides.find(std::get<std::string>(scene->value));
    if (own != config.scene_overrides.end()) std::for_each(own->second.begin(), own->second.end(), add);
  }
  for (const Setting& s : config.fixed) add({s.parameter, s.values.front(), s.places.front()});
  return base;
}

bool is_of_scene(const GivenSet& point, const Given* scene) {
  const Given* own = scene ? find_given(point, scene->parameter) : nullptr;
  return !own || own->value == scene->value;
}

// Whether points that name no scene are among those of `scene`.
bool is_base_scene(const Config& config, const Given& scene) {
  const auto gives = [&](const Setting& s) {
    return s.parameter == scene.parameter &&
           std::find(s.values.begin(), s.values.end(), scene.value) != s.values.end();
  };
  return std::any_of(config.sweep.begin(), config.sweep.end(), gives) ||
         std::any_of(config.fixed.begin(), config.fixed.end(), gives);
}

// The listed points of a scene, each completed from `base` to the parameters that any of them gives.
Axis listed_points(const Config& config, const Given* scene, const GivenSet& base) {
  Axis axis;
  std::vector<const Parameter*> parameters;
  for (const GivenSet& point : config.points) {
    for (const Given& given : point) {
      if (std::find(parameters.begin(), parameters.end(), given.parameter) == parameters.end())
        parameters.push_back(given.parameter);
    }
  }
  for (const GivenSet& point : config.points) {
    if (!is_of_scene(point, scene)) continue;
    if (scene && !find_given(point, scene->parameter) && !is_base_scene(config, *scene)) continue;
    GivenSet entry;
    for (const Parameter* parameter : parameters) {
      const Given* own = find_given(point, parameter);
      entry.push_back(own ? *own : *find_given(base, parameter));
    }
    axis.push_back(std::move(entry));
  }
  return axis;
}

Axis swept(const Setting& setting) {
  Axis axis;
  for (size_t i = 0; i < setting.values.size(); ++i) {
    for (const Value& value : expanded(*setting.parameter, setting.values[i]))
      axis.push_back({{setting.parameter, value, setting.places[i]}});
  }
  return axis;
}

// Entries whose camera stands for several seeded ones become one for each of them.
Axis with_seeded_cameras(const Axis& axis) {
  Axis result;
  for (const GivenSet& entry : axis) {
    std::vector<GivenSet> entries = {entry};
    for (size_t i = 0; i < entry.size(); ++i) {
      const std::vector<Value> values = expanded(*entry[i].parameter, entry[i].value);
      if (values.size() == 1 && values.front() == entry[i].value) continue;
      entries.assign(values.size(), entry);
      for (size_t v = 0; v < values.size(); ++v) entries[v][i].value = values[v];
    }
    result.insert(result.end(), entries.begin(), entries.end());
  }
  return result;
}

bool is_given(const std::vector<Axis>& axes, const Parameter* parameter) {
  return std::any_of(axes.begin(), axes.end(),
                     [&](const Axis& axis) { return !axis.empty() && find_given(axis.front(), parameter); });
}

}  // namespace

std::vector<Axis> axes_of(const Config& config, const Given* scene) {
  const GivenSet base = base_of(config, scene);
  std::vector<Axis> axes;
  if (!config.points.empty()) axes.push_back(with_seeded_cameras(listed_points(config, scene, base)));
  for (const Setting& setting : config.sweep) {
    if (!scene || setting.parameter != scene->parameter) axes.push_back(swept(setting));
  }
  GivenSet rest;
  for (const Given& given : base) {
    if (is_given(axes, given.parameter)) continue;
    if (stands_for_cameras(*given.parameter, given.value))
      axes.insert(axes.begin(), with_seeded_cameras({{given}}));
    else
      rest.push_back(given);
  }
  axes.push_back({rest});
  return axes;
}

void expand_cameras(std::vector<Axis>& axes, const std::vector<std::string>& cameras) {
  for (Axis& axis : axes) {
    Axis expanded;
    for (const GivenSet& entry : axis) {
      const auto star = std::find_if(entry.begin(), entry.end(), [](const Given& given) {
        return stands_for_every_camera(*given.parameter, given.value);
      });
      if (star == entry.end()) {
        expanded.push_back(entry);
        continue;
      }
      for (const std::string& camera : cameras) {
        expanded.push_back(entry);
        expanded.back()[static_cast<size_t>(star - entry.begin())].value = camera;
      }
    }
    axis = std::move(expanded);
  }
}

double combination_count(const std::vector<Axis>& axes) {
  double count = 1;
  for (const Axis& axis : axes) count *= static_cast<double>(axis.size());
  return count;
}

std::map<std::string, Value> values_of(const Combination& combination) {
  std::map<std::string, Value> values;
  for (const auto& [name, given] : combination) values[name] = given->value;
  return values;
}

void for_each_combination(const std::vector<Axis>& axes,
                          const std::function<void(const Combination&)>& visit) {
  if (std::any_of(axes.begin(), axes.end(), [](const Axis& axis) { return axis.empty(); })) return;
  std::vector<size_t> index(axes.size(), 0);
  while (true) {
    Combination combination;
    for (size_t a = 0; a < axes.size(); ++a) {
      for (const Given& given : axes[a][index[a]]) combination[given.parameter->name] = &given;
    }
    visit(combination);
    size_t a = axes.size();
    while (a > 0 && ++index[a - 1] == axes[a - 1].size()) index[--a] = 0;
    if (a == 0) return;
  }
}

}  // namespace hybray
