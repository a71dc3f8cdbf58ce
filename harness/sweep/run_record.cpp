#include "harness/sweep/run_record.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "harness/table/files.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace hybray {
namespace {

constexpr const char *kManifest = "manifest.json", *kPartialManifest = "manifest.json.partial";

double unix_time_s() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

}  // namespace

void check_folder_is_free_for(const std::filesystem::path& folder, const std::string& name) {
  for (const char* file : {kManifest, kPartialManifest}) {
    const auto manifest = read_manifest(folder / file);
    if (!manifest || manifest->table.empty() || manifest->table == name + ".csv") continue;
    throw InputError(folder.string(), fmt::format("it holds {}, whose manifest a run of {} would replace; "
                                                  "choose another folder",
                                                  manifest->table, name));
  }
}

RunRecord::RunRecord(const RunRequest& request, const std::filesystem::path& folder)
    : request_(request),
      folder_(folder),
      manifest_(folder / kManifest),
      partial_manifest_(folder / kPartialManifest),
      origin_(row_origin(request.choices.timing, request.choices.threads)) {
  const std::string &name = request.config.name, header = table_header(request.config.experiment->columns);
  EarlierRows earlier;
  if (request.choices.fresh)
    earlier.fresh = true;
  else
    earlier = find_earlier_rows(folder, name, header, origin_);
  remarks_ = std::move(earlier.remarks);

  for (const Point& point : request.points) ids_.push_back(point.id);
  state_.table = name + ".csv";
  state_.points = ids_.size();
  state_.reused = static_cast<size_t>(std::count_if(
      ids_.begin(), ids_.end(), [&](const std::string& id) { return earlier.lines.contains(id); }));
  state_.done = state_.reused;
  state_.fresh = earlier.fresh;
  state_.sessions = std::move(earlier.sessions);
  state_.sessions.push_back({unix_time_s(), {}});

  // The growing table and its manifest must fit one another at any moment: a table that the new manifest does
  // not describe goes before that comes.
  clear_partial_table(earlier.partial);
  state_.stopped = true;  // as long as nothing else is known
  replace_file(partial_manifest_, text());
  table_ = std::make_unique<GrowingTable>(folder, name, header, std::move(earlier.lines));
}

void RunRecord::clear_partial_table(PartialRows rows) {
  if (rows == PartialRows::taken_over) return;
  const std::filesystem::path partial = folder_ / (state_.table + ".partial");
  std::error_code ignored;
  if (rows == PartialRows::foreign) {
    std::filesystem::rename(partial, partial.string() + ".old", ignored);
    std::filesystem::rename(partial_manifest_, partial_manifest_.string() + ".old", ignored);
    remarks_.push_back(fmt::format("{} is set aside as {}.old", partial.string(), partial.string()));
  }
  std::filesystem::remove(partial, ignored);
}

std::vector<const Point*> RunRecord::to_do() const {
  std::vector<const Point*> points;
  for (const Point& point : request_.points) {
    if (!table_->lines().contains(point.id)) points.push_back(&point);
  }
  return points;
}

void RunRecord::done(const Point& point, std::string line) {
  table_->append(point.id, std::move(line));
  ++state_.done;
}

void RunRecord::failed(const Point& point, const std::string& message) {
  state_.failures.push_back({point, message});
}

std::filesystem::path RunRecord::close(bool stopped) {
  state_.stopped = stopped;
  state_.sessions.back().wall_time_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const bool has_table = state_.done > 0;
  if (stopped && has_table) {
    replace_file(partial_manifest_, text());
    return table_->partial_file();
  }
  if (has_table) {
    const std::string content = table_->content(ids_);
    replace_file(table_->file(), content);
    state_.content_hash = hash_text(content);
  } else {
    state_.table.clear();
  }
  if (has_table || (!stopped && request_.choices.shard && ids_.empty())) replace_file(manifest_, text());
  if (!has_rows_of_others()) remove_partial_files();
  return has_table ? table_->file() : std::filesystem::path();
}

std::string RunRecord::text() const {
  return manifest_text(request_.config, request_.sweep, request_.choices, origin_, state_);
}

bool RunRecord::has_rows_of_others() const {
  return table_->lines().size() > state_.done;
}

void RunRecord::remove_partial_files() {
  std::error_code ignored;  // what they hold is in the complete table
  std::filesystem::remove(partial_manifest_, ignored);
  table_->remove_partial();
}

}  // namespace hybray
