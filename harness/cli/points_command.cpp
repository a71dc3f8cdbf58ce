#include "harness/cli/commands.h"
#include "harness/cli/log.h"
#include "harness/cli/progress.h"
#include "harness/config/json_value.h"
#include "harness/sweep/memory.h"
#include "harness/sweep/plan.h"
#include "harness/sweep/run_sweep.h"
#include "harness/sweep/shard.h"
#include "harness/table/csv.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

// A config with what each of its points costs.
struct Listing {
  const PlannedConfig* planned;
  std::vector<double> seconds;  // by point

  const std::vector<Point>& points() const { return planned->sweep.points; }
  const Experiment& experiment() const { return *planned->config.experiment; }
  double total_seconds() const { return std::accumulate(seconds.begin(), seconds.end(), 0.0); }
  double memory_bytes(const Point& point) const {
    return experiment().memory_bytes ? experiment().memory_bytes(point) : 0.0;
  }
};

void print_text(const std::vector<Listing>& listings) {
  bool first = true;
  for (const Listing& listing : listings) {
    if (listing.points().empty()) continue;
    if (listings.size() > 1) fmt::print("{}{}\n", first ? "" : "\n", listing.planned->config.name);
    first = false;
    for (size_t i = 0; i < listing.points().size(); ++i) {
      const Point& point = listing.points()[i];
      fmt::print("{}  {}  about {:.2g} s, {}\n", point.id, point_label(listing.planned->config, point),
                 listing.seconds[i], format_bytes(listing.memory_bytes(point)));
    }
  }
}

// One row a point; a column for each parameter of any of the experiments.
void print_csv(const std::vector<Listing>& listings) {
  std::vector<std::string> names;
  for (const Listing& listing : listings) {
    for (const Parameter& p : listing.experiment().parameters) {
      if (std::find(names.begin(), names.end(), p.name) == names.end()) names.push_back(p.name);
    }
  }
  std::vector<std::string> cells{"config", "experiment", "id", "cost_s", "memory_bytes"};
  cells.insert(cells.end(), names.begin(), names.end());
  fmt::print("{}", csv_line(cells));
  for (const Listing& listing : listings) {
    for (size_t i = 0; i < listing.points().size(); ++i) {
      const Point& point = listing.points()[i];
      cells = {listing.planned->config.name, listing.experiment().name, point.id, to_text(listing.seconds[i]),
               to_text(listing.memory_bytes(point))};
      for (const std::string& name : names) {
        const auto value = point.parameters.find(name);
        cells.push_back(value == point.parameters.end() ? "" : to_text(value->second));
      }
      fmt::print("{}", csv_line(cells));
    }
  }
}

void print_json(const std::vector<Listing>& listings) {
  using Json = nlohmann::ordered_json;
  Json root;
  root["configs"] = Json::array();
  double total = 0;
  for (const Listing& listing : listings) {
    const Config& config = listing.planned->config;
    Json json{{"config", config.name},
              {"file", config.file.string()},
              {"experiment", listing.experiment().name},
              {"seed", config.seed},
              {"cost_s", listing.total_seconds()},
              {"skipped_scenes", Json::array()},
              {"points", Json::array()}};
    for (const SkippedScene& skipped : listing.planned->sweep.skipped)
      json["skipped_scenes"].push_back(skipped.scene);
    for (size_t i = 0; i < listing.points().size(); ++i) {
      const Point& point = listing.points()[i];
      Json parameters = Json::object();
      for (const Parameter& p : listing.experiment().parameters)
        parameters[p.name] = to_json(point.parameters.at(p.name));
      json["points"].push_back({{"id", point.id},
                                {"cost_s", listing.seconds[i]},
                                {"memory_bytes", listing.memory_bytes(point)},
                                {"parameters", parameters}});
    }
    root["configs"].push_back(json);
    total += listing.total_seconds();
  }
  root["cost_s"] = total;
  fmt::print("{}\n", root.dump(2, ' ', false, Json::error_handler_t::replace));
}

void log_totals(const std::vector<Listing>& listings) {
  size_t points = 0;
  double seconds = 0;
  for (const Listing& listing : listings) {
    const double own = listing.total_seconds();
    if (listings.size() > 1 && !listing.points().empty())
      log_info(fmt::format("{}: {} points, about {}", listing.planned->config.name, listing.points().size(),
                           format_duration(own)));
    for (const SkippedScene& skipped : listing.planned->sweep.skipped) {
      log_warning(
          fmt::format("the optional scene \"{}\" is left out, since its source is missing", skipped.scene));
    }
    points += listing.points().size();
    seconds += own;
  }
  log_info(fmt::format("{} points, about {} in all", points, format_duration(seconds)));
}

}  // namespace

int points_command(const Environment& environment, const PointsOptions& options) {
  SceneCatalog scenes(environment.scene_paths);
  Plan plan =
      make_plan({options.configs, options.assignments, options.filters}, environment.experiments, scenes);
  std::vector<Listing> listings;
  for (PlannedConfig& planned : plan.configs) {
    const Experiment& experiment = *planned.config.experiment;
    if (!options.shard.empty())
      planned.sweep.points = points_of_shard(experiment, planned.sweep, parse_shard(options.shard));
    listings.push_back({&planned, estimated_seconds(experiment, planned.sweep)});
  }
  switch (options.format) {
    case PointsFormat::text:
      print_text(listings);
      break;
    case PointsFormat::csv:
      print_csv(listings);
      break;
    case PointsFormat::json:
      print_json(listings);
      break;
  }
  log_totals(listings);
  return kOk;
}

}  // namespace hybray
