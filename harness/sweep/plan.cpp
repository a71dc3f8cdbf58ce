#include "harness/sweep/plan.h"

#include "core/base/error.h"
#include "harness/config/config_check.h"
#include "harness/config/parameter_rules.h"
#include "harness/config/suite.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace hybray {
namespace {

// A config with what changes it, before it is checked.
struct Source {
  std::filesystem::path file;
  JsonSource document;
  const Experiment* experiment;
  std::vector<Assignment> assignments, suite_filters, filters;
};

std::vector<Source> read_sources(const std::vector<std::string>& files,
                                 std::span<const Experiment> experiments) {
  std::vector<Source> sources;
  const auto add = [&](const std::filesystem::path& file, JsonSource document) -> Source& {
    const Experiment& experiment = experiment_of(document, experiments);
    return sources.emplace_back(Source{file, std::move(document), &experiment, {}, {}, {}});
  };
  for (const std::string& file : files) {
    JsonSource document = JsonSource::read(file);
    if (!is_suite(document)) {
      add(file, std::move(document));
      continue;
    }
    for (SuiteEntry& entry : read_suite(document, file).entries) {
      JsonSource config = JsonSource::read(entry.config);
      if (is_suite(config)) {
        throw InputError(entry.place,
                         entry.config.string() + " is a suite itself; a suite lists configs only");
      }
      Source& source = add(entry.config, std::move(config));
      source.assignments = std::move(entry.assignments);
      source.suite_filters = std::move(entry.filters);
    }
  }
  return sources;
}

bool knows(const Source& source, const std::string& key) {
  return find_parameter(*source.experiment, key) != nullptr;
}

// Throws for a key that is a parameter of none of the configs.
void check_known(const std::vector<Source>& sources, const Assignment& assignment) {
  std::vector<std::string> names;
  for (const Source& source : sources) {
    for (const Parameter& p : source.experiment->parameters) {
      if (p.name == assignment.key) return;
      if (std::find(names.begin(), names.end(), p.name) == names.end()) names.push_back(p.name);
    }
  }
  throw InputError(assignment.place, unknown_name("parameter", assignment.key, names));
}

std::vector<std::string> texts_of(const std::vector<Assignment>& assignments) {
  std::vector<std::string> texts;
  for (const Assignment& a : assignments) texts.push_back(a.key + "=" + a.text);
  return texts;
}

}  // namespace

Plan make_plan(const PlanRequest& request, std::span<const Experiment> experiments, SceneCatalog& scenes) {
  std::vector<Source> sources = read_sources(request.files, experiments);
  const std::vector<Assignment> assignments = assignments_of("--set", request.assignments),
                                filters = assignments_of("--filter", request.filters);
  for (const Assignment& a : assignments) {
    if (a.key != "seed") check_known(sources, a);
    for (Source& source : sources) {
      if (a.key == "seed" || knows(source, a.key)) source.assignments.push_back(a);
    }
  }
  std::vector<bool> matches(sources.size(), true);
  for (const Assignment& f : filters) {
    check_known(sources, f);
    for (size_t i = 0; i < sources.size(); ++i) {
      if (knows(sources[i], f.key))
        sources[i].filters.push_back(f);
      else
        matches[i] = false;
    }
  }

  Plan plan;
  plan.is_single = sources.size() == 1 && sources.front().file == request.files.front();
  for (const Source& source : sources) {
    std::vector<Assignment> all_filters = source.suite_filters;
    all_filters.insert(all_filters.end(), source.filters.begin(), source.filters.end());
    plan.configs.push_back({load_config(source.document, source.file, experiments, source.assignments),
                            {},
                            texts_of(source.assignments),
                            texts_of(all_filters)});
  }
  bool any = false;
  for (size_t i = 0; i < sources.size(); ++i) {
    PlannedConfig& planned = plan.configs[i];
    // A filter of the command line may suit only some configs; that of a suite is meant for the one.
    const bool may_be_empty = sources.size() > 1 && !filters.empty();
    const FreezeOptions options{sources[i].filters, request.memory_bytes, may_be_empty,
                                sources[i].suite_filters};
    if (matches[i]) planned.sweep = freeze(planned.config, scenes, options);
    any = any || !planned.sweep.points.empty() || !planned.sweep.skipped.empty();
  }
  if (!any) throw InputError(filters.front().place, "no point of any of the configs matches");
  return plan;
}

std::vector<double> estimated_seconds(const Experiment& experiment, const FrozenSweep& sweep) {
  const Parameter* scene = parameter_of_type(experiment, ParameterType::scene);
  std::vector<double> seconds;
  std::set<std::string> paid;
  for (const Point& point : sweep.points) {
    const SceneFacts facts = scene ? sweep.scenes.at(point.text(scene->name)) : SceneFacts{};
    double cost = experiment.cost_seconds ? experiment.cost_seconds(point, facts) : 0.0;
    const auto shared_costs =
        experiment.shared_costs ? experiment.shared_costs(point, facts) : std::vector<SharedCost>{};
    for (const SharedCost& shared : shared_costs) {
      if (paid.insert(shared.key).second) cost += shared.seconds;
    }
    seconds.push_back(std::round(1e3 * cost) / 1e3);  // more digits would mean nothing
  }
  return seconds;
}

}  // namespace hybray
