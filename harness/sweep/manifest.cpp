#include "harness/sweep/manifest.h"

#include "core/base/hash.h"
#include "harness/config/json_value.h"
#include "harness/table/build_info.h"

#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

Json config_json(const Config& config, const RunChoices& choices) {
  Json json;
  json["file"] = config.file.filename().string();
  json["experiment"] = config.experiment->name;
  json["title"] = config.title;
  json["seed"] = config.seed;
  json["parameters"] = Json::object();
  for (const Setting& setting : config.fixed) {
    json["parameters"][setting.parameter->name] = to_json(setting.values.front());
  }
  json["sweep"] = Json::object();
  for (const Setting& setting : config.sweep) {
    Json& values = json["sweep"][setting.parameter->name] = Json::array();
    for (const Value& value : setting.values) values.push_back(to_json(value));
  }
  json["optional_scenes"] = config.optional_scenes;
  json["set"] = choices.assignments;
  json["filter"] = choices.filters;
  return json;
}

Json program_json() {
  const BuildInfo build = build_info();
  Json json{{"version", build.version},     {"git_commit", build.git_commit},
            {"git_dirty", build.git_dirty}, {"build_type", build.build_type},
            {"compiler", build.compiler},   {"flags", build.flags}};
  for (const auto& [name, version] : build.libraries) json["libraries"][name] = version;
  return json;
}

Json machine_json() {
  const MachineInfo machine = machine_info();
  return {{"cpu", machine.cpu},
          {"instruction_sets", machine.features},
          {"hardware_threads", machine.hardware_threads},
          {"memory_bytes", static_cast<uint64_t>(machine.memory_bytes)}};
}

}  // namespace

std::string manifest_text(const Config& config, const FrozenSweep& sweep, const RunResult& result,
                          const RunChoices& choices) {
  Json json;
  json["config"] = config_json(config, choices);
  json["program"] = program_json();
  json["machine"] = machine_json();
  json["scenes"] = Json::object();
  for (const auto& [name, facts] : sweep.scenes) {
    json["scenes"][name] = {{"content_hash", hex(facts.content_hash)}, {"triangles", facts.triangles}};
  }
  json["skipped_scenes"] = Json::array();
  for (const SkippedScene& skipped : sweep.skipped) json["skipped_scenes"].push_back(skipped.scene);
  json["run"] = {{"points", sweep.points.size()},     {"points_done", result.done},
                 {"points_failed", result.failed},    {"complete", !result.stopped && result.failed == 0},
                 {"threads", choices.threads},        {"timing", choices.timing},
                 {"wall_time_s", result.wall_seconds}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace hybray
