// What a run leaves in its folder: table and manifest, each step in an order that lets any moment be the
// last.
#pragma once

#include "harness/sweep/earlier_rows.h"
#include "harness/sweep/manifest.h"
#include "harness/table/growing_table.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace hybray {

// The parts of a run that are settled before it starts. The config and the sweep must outlive it.
struct RunRequest {
  const Config& config;
  const FrozenSweep& sweep;   // the whole one
  std::vector<Point> points;  // that this run is to have rows of: the sweep's, or those of its shard
  RunChoices choices;
};

// Throws InputError where the folder's manifest is that of another table, which a run of this one would
// replace.
void check_folder_is_free_for(const std::filesystem::path& folder, const std::string& name);

class RunRecord {
 public:
  // Takes over what it can of earlier sessions (find_earlier_rows), unless the run is to start over, and
  // begins the growing table and its manifest. Growing rows that are of another origin are set aside as
  // NAME.csv.partial.old. Throws RuntimeError where it cannot write.
  RunRecord(const RunRequest& request, const std::filesystem::path& folder);

  // Points without a row, in frozen order.
  std::vector<const Point*> to_do() const;
  size_t reused() const { return state_.reused; }
  const std::vector<std::string>& remarks() const {
    return remarks_;
  }  // as EarlierRows, and of what is set aside

  // Keeps the line of a point; throws what GrowingTable::append throws.
  void done(const Point& point, std::string line);
  void failed(const Point& point, const std::string& message);
  // For the manifest: where the session's references came from.
  void count_references(const ReferenceCounts& references) { state_.references = references; }

  // Ends the session. A run that came to its last point gets its NAME.csv and manifest.json in place of
  // earlier ones; a stopped one keeps NAME.csv.partial and manifest.json.partial. Rows of points that are not
  // of this run stay in NAME.csv.partial. Without a row nothing is left behind, and an earlier table stays;
  // only a shard without points says so in a manifest. Returns the file that holds the rows; empty: there is
  // none.
  std::filesystem::path close(bool stopped);

  const RunState& state() const { return state_; }

 private:
  void clear_partial_table(PartialRows rows);
  std::string text() const;
  bool has_rows_of_others() const;
  void remove_partial_files();

  const RunRequest& request_;
  const std::filesystem::path folder_, manifest_, partial_manifest_;
  RowOrigin origin_;
  RunState state_;
  std::vector<std::string> ids_;  // of the run's points
  std::vector<std::string> remarks_;
  std::unique_ptr<GrowingTable> table_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace hybray
