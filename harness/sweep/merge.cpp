#include "harness/sweep/merge.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "harness/config/parameter_rules.h"
#include "harness/sweep/run_record.h"
#include "harness/table/csv.h"
#include "harness/table/files.h"
#include "harness/table/folder_lock.h"
#include "harness/table/growing_table.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// One folder to merge.
struct Part {
  fs::path folder;
  Json manifest;
  CsvTable table;  // without rows where no point of the shard has one
};

Part read_part(const fs::path& folder) {
  const fs::path file = folder / "manifest.json";
  if (!fs::exists(file)) {
    throw InputError(folder.string(), fs::exists(folder / "manifest.json.partial")
                                          ? "the run there has not come to its end; run it again to resume it"
                                          : "there is no manifest.json");
  }
  Part part{folder, {}, {}};
  try {
    part.manifest = Json::parse(read_file(file));
    for (const char* needed :
         {"/config/experiment", "/config/file", "/points", "/machine", "/row_origin/program", "/run/timing",
          "/run/points_reused", "/run/wall_time_s", "/run/sessions", "/run/failures"})
      part.manifest.at(Json::json_pointer(needed));
    const std::string table = part.manifest.at("table").at("file");
    if (table.empty()) return part;
    const std::string text = read_file(folder / table);
    if (hex(hash_text(text)) != part.manifest.at("table").at("content_hash").get<std::string>())
      throw InputError((folder / table).string(), "it is not the table that manifest.json describes");
    part.table = parse_csv(text, (folder / table).string());
  } catch (const Json::exception&) {
    throw InputError(file.string(), "it is not a manifest of this program");
  }
  return part;
}

// The parts of a manifest that all shards of one run have in common, and how they are called.
const std::pair<Json::json_pointer, const char*> kCommon[] = {
    {Json::json_pointer("/config"), "config"},
    {Json::json_pointer("/row_origin/program"), "program"},
    {Json::json_pointer("/run/timing"), "choice of timing"},
    {Json::json_pointer("/points"), "points (is a scene another one there, or missing?)"}};

void check_same_run(const Part& first, const Part& part) {
  for (const auto& [pointer, what] : kCommon) {
    if (part.manifest.at(pointer) == first.manifest.at(pointer)) continue;
    throw InputError(part.folder.string(),
                     fmt::format("it is of another run than {}: another {}", first.folder.string(), what));
  }
}

const Experiment& experiment_of(const Part& part, std::span<const Experiment> experiments) {
  const std::string name = part.manifest.at("config").at("experiment");
  if (const Experiment* found = find_experiment(name, experiments)) return *found;
  throw InputError(part.folder.string(), unknown_experiment(name, experiments));
}

// The rows of all parts, by id.
using Rows = std::map<std::string, const std::vector<std::string>*>;

// Throws where two rows of one point cannot both be right.
void check_agreement(const Experiment& experiment, const std::vector<std::string>& a,
                     const std::vector<std::string>& b, const Part& part) {
  for (size_t c = 0; c < experiment.columns.size(); ++c) {
    const Column& column = experiment.columns[c];
    if (column.kind != ColumnKind::metric && column.kind != ColumnKind::count) continue;
    if (a[c + 1] == b[c + 1]) continue;
    throw InputError(part.folder.string(),
                     fmt::format("point {} has another {} there than in the folders before: {} and {}", a[0],
                                 column.name, b[c + 1], a[c + 1]));
  }
}

Rows rows_of(const std::vector<Part>& parts, const Experiment& experiment) {
  Rows rows;
  for (const Part& part : parts) {
    if (part.table.rows.empty()) continue;
    if (csv_line(part.table.header) != table_header(experiment.columns))
      throw InputError(part.folder.string(), "its columns are not those that this program knows");
    for (const auto& row : part.table.rows) {
      const auto [place, is_new] = rows.emplace(row.front(), &row);
      if (!is_new) check_agreement(experiment, *place->second, row, part);
    }
  }
  return rows;
}

[[noreturn]] void refuse_missing(const std::vector<Part>& parts, const std::vector<std::string>& missing) {
  std::string what =
      fmt::format("{} points have no row, the first of them {}", missing.size(), missing.front());
  for (const Part& part : parts) {
    const size_t failed = part.manifest.at("run").at("failures").size();
    if (failed > 0) what += fmt::format("; {} failed in {}", failed, part.folder.string());
  }
  throw InputError("merge", what + " (--allow-missing merges the others)");
}

// Whether a list of texts, as common_origin writes it, has this one.
bool lists(const std::string& all, const std::string& text) {
  constexpr const char* kBetween = " | ";
  return (kBetween + all + kBetween).find(kBetween + text + kBetween) != std::string::npos;
}

// Where machine, threads or the like differ, all values: no single run is of that origin.
Json common_origin(const std::vector<Part>& parts, std::vector<std::string>& warnings) {
  Json origin = Json::object();
  for (const Part& part : parts) {
    for (const auto& [name, value] : part.manifest.at("row_origin").items()) {
      if (!origin.contains(name)) {
        origin[name] = value;
      } else if (std::string all = origin[name]; !lists(all, value.get<std::string>())) {
        origin[name] = all + " | " + value.get<std::string>();
        warnings.push_back(
            fmt::format("{} has rows of another {}: {}", part.folder.string(), name, value.dump()));
      }
    }
  }
  return origin;
}

Json merged_run(const std::vector<Part>& parts, const Rows& rows, size_t points) {
  Json run = parts.front().manifest.at("run");
  run["points"] = points;
  run["points_done"] = rows.size();
  run["complete"] = rows.size() == points;
  run["points_reused"] = 0;
  run["fresh"] = false;
  run["wall_time_s"] = 0.0;
  for (const char* list : {"sessions", "failures"}) run[list] = Json::array();
  std::set<std::string> failed;
  for (const Part& part : parts) {
    const Json& own = part.manifest.at("run");
    run["points_reused"] = run["points_reused"].get<size_t>() + own.at("points_reused").get<size_t>();
    run["wall_time_s"] = run["wall_time_s"].get<double>() + own.at("wall_time_s").get<double>();
    for (const Json& session : own.at("sessions")) run["sessions"].push_back(session);
    for (const Json& failure : own.at("failures")) {
      const std::string id = failure.at("id");
      if (!rows.contains(id) && failed.insert(id).second) run["failures"].push_back(failure);
    }
  }
  run["points_failed"] = run["failures"].size();
  return run;
}

// Counts of all parts together. The cache may have been on in some of them only; the shards say in which.
Json merged_references(const std::vector<Part>& parts) {
  Json sum = Json::object();
  for (const Part& part : parts) {
    const Json own = part.manifest.value("references", Json::object());
    for (const auto& [name, value] : own.items())
      sum[name] =
          value.is_number_unsigned() ? Json(sum.value(name, uint64_t{0}) + value.get<uint64_t>()) : value;
  }
  return sum;
}

Json merged_manifest(const std::vector<Part>& parts, const Rows& rows, const std::string& table,
                     const std::string& content, std::vector<std::string>& warnings) {
  Json merged = parts.front().manifest;
  merged.erase("shard");
  merged["table"] = {{"file", table}, {"content_hash", hex(hash_text(content))}};
  merged["row_origin"] = common_origin(parts, warnings);
  merged["run"] = merged_run(parts, rows, merged.at("points").size());
  merged["references"] = merged_references(parts);
  Json shards = Json::array();
  for (const Part& part : parts) {
    Json shard = Json::object();
    for (const char* key : {"shard", "machine", "row_origin", "run", "references"}) {
      if (part.manifest.contains(key)) shard[key] = part.manifest.at(key);
    }
    shards.push_back(std::move(shard));
  }
  merged["shards"] = std::move(shards);
  return merged;
}

void copy_pictures(const fs::path& from, const fs::path& to) {
  if (!fs::is_directory(from)) return;
  for (const auto& entry : fs::directory_iterator(from)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".partial") continue;
    fs::create_directories(to);
    replace_file(to / entry.path().filename(), read_file(entry.path()));
  }
}

}  // namespace

MergeResult merge_tables(std::span<const Experiment> experiments, std::span<const fs::path> folders,
                         const fs::path& output, bool allow_missing) {
  std::vector<Part> parts;
  for (const fs::path& folder : folders) {
    std::error_code is_not_there;
    if (fs::equivalent(folder, output, is_not_there))
      throw InputError(output.string(), "the output folder is one of those to merge");
    parts.push_back(read_part(folder));
    check_same_run(parts.front(), parts.back());
  }
  const Experiment& experiment = experiment_of(parts.front(), experiments);
  const Rows rows = rows_of(parts, experiment);

  MergeResult result;
  const auto points = parts.front().manifest.at("points").get<std::vector<std::string>>();
  std::string content = table_header(experiment.columns);
  std::vector<std::string> missing;
  for (const std::string& id : points) {
    if (const auto row = rows.find(id); row != rows.end())
      content += csv_line(*row->second);
    else
      missing.push_back(id);
  }
  if (!missing.empty() && (!allow_missing || missing.size() == points.size())) refuse_missing(parts, missing);

  const std::string name = fs::path(parts.front().manifest.at("config").at("file").get<std::string>()).stem();
  const std::string manifest = merged_manifest(parts, rows, name + ".csv", content, result.warnings)
                                   .dump(2, ' ', false, Json::error_handler_t::replace) +
                               '\n';
  make_writable_folder(output, content.size() + manifest.size());
  const FolderLock lock(output);
  check_folder_is_free_for(output, name);
  for (const Part& part : parts) copy_pictures(part.folder / "pictures", output / "pictures");
  result.table = output / (name + ".csv");
  replace_file(result.table, content);
  replace_file(output / "manifest.json", manifest);
  result.points = points.size();
  result.missing = missing.size();
  return result;
}

}  // namespace hybray
