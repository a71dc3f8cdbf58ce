#include "harness/sweep/manifest.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "harness/config/json_value.h"
#include "harness/table/build_info.h"
#include "harness/table/files.h"

#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

Json set_json(const GivenSet& set) {
  Json json = Json::object();
  for (const Given& given : set) json[given.parameter->name] = to_json(given.value);
  return json;
}

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
  if (!config.points.empty()) json["points"] = Json::array();
  for (const GivenSet& point : config.points) json["points"].push_back(set_json(point));
  json["sweep"] = Json::object();
  for (const Setting& setting : config.sweep) {
    Json& values = json["sweep"][setting.parameter->name] = Json::array();
    for (const Value& value : setting.values) values.push_back(to_json(value));
  }
  for (const auto& [scene, set] : config.scene_overrides) json["scenes"][scene] = set_json(set);
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

Json sessions_json(const std::vector<Session>& sessions) {
  Json json = Json::array();
  for (const Session& session : sessions) {
    json.push_back({{"start_unix_s", session.start_unix_s}, {"wall_time_s", nullptr}});
    if (session.wall_time_s) json.back()["wall_time_s"] = *session.wall_time_s;
  }
  return json;
}

Json run_json(const RunChoices& choices, const RunState& state) {
  Json json{{"points", state.points},
            {"points_done", state.done},
            {"points_reused", state.reused},
            {"points_failed", state.failures.size()},
            {"complete", !state.stopped && state.done == state.points},
            {"threads", choices.threads},
            {"timing", choices.timing},
            {"fresh", state.fresh},
            {"wall_time_s", total_wall_time_s(state.sessions)},
            {"sessions", sessions_json(state.sessions)}};
  json["failures"] = Json::array();
  for (const Failure& failure : state.failures) {
    Json parameters = Json::object();
    for (const auto& [name, value] : failure.point.parameters) parameters[name] = to_json(value);
    json["failures"].push_back(
        {{"id", failure.point.id}, {"parameters", parameters}, {"message", failure.message}});
  }
  return json;
}

}  // namespace

std::string manifest_text(const Config& config, const FrozenSweep& sweep, const RunChoices& choices,
                          const RowOrigin& origin, const RunState& state) {
  Json json;
  json["config"] = config_json(config, choices);
  if (choices.shard) json["shard"] = {{"index", choices.shard->index}, {"count", choices.shard->count}};
  json["program"] = program_json();
  json["machine"] = machine_json();
  json["scenes"] = Json::object();
  for (const auto& [name, facts] : sweep.scenes) {
    json["scenes"][name] = {{"content_hash", hex(facts.content_hash)}, {"triangles", facts.triangles}};
  }
  json["skipped_scenes"] = Json::array();
  for (const SkippedScene& skipped : sweep.skipped) json["skipped_scenes"].push_back(skipped.scene);
  json["table"] = {{"file", state.table},
                   {"content_hash", state.content_hash ? hex(*state.content_hash) : ""}};
  json["row_origin"] = origin;
  json["run"] = run_json(choices, state);
  json["points"] = Json::array();
  for (const Point& point : sweep.points) json["points"].push_back(point.id);
  const ReferenceCounts& references = state.references;
  json["references"] = {{"computed", references.computed},
                        {"continued", references.continued},
                        {"reused", references.reused},
                        {"batches_computed", references.batches_computed},
                        {"batches_reused", references.batches_reused},
                        {"cache_enabled", choices.cache}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::optional<EarlierManifest> read_manifest(const std::filesystem::path& file) {
  try {
    const Json json = Json::parse(read_file(file));
    EarlierManifest manifest;
    manifest.table = json.at("table").at("file");
    manifest.content_hash = json.at("table").at("content_hash");
    manifest.origin = json.at("row_origin").get<RowOrigin>();
    manifest.fresh = json.at("run").at("fresh");
    for (const Json& session : json.at("run").at("sessions")) {
      manifest.sessions.push_back({session.at("start_unix_s"), {}});
      const Json& wall_time = session.at("wall_time_s");
      if (!wall_time.is_null()) manifest.sessions.back().wall_time_s = wall_time.get<double>();
    }
    return manifest;
  } catch (const InputError&) {
    return std::nullopt;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

double total_wall_time_s(const std::vector<Session>& sessions) {
  double total = 0;
  for (const Session& session : sessions) total += session.wall_time_s.value_or(0);
  return total;
}

}  // namespace hybray
