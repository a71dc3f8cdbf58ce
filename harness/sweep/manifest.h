// manifest.json: what made a table, beside it. manifest.json.partial: the same of a table that still grows.
#pragma once

#include "harness/config/config.h"
#include "harness/experiments/workspace.h"
#include "harness/sweep/freeze.h"
#include "harness/sweep/row_origin.h"
#include "harness/sweep/shard.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hybray {

// What the command line chose for a run.
struct RunChoices {
  std::vector<std::string> assignments, filters;
  bool timing = true;
  int threads = 0;  // that parallel loops could use
  std::optional<Shard> shard;
  bool fresh = false;  // take over no row of an earlier session
  bool cache = false;  // whether references could be kept on disk
};

// One stretch of work on a table; an interrupted and resumed run has several.
struct Session {
  double start_unix_s = 0;            // seconds since 1970 (UTC)
  std::optional<double> wall_time_s;  // none while it lasts
};

struct Failure {
  Point point;
  std::string message;
};

// How far a table is.
struct RunState {
  std::string table;                     // name of its file; empty: no point has a row
  std::optional<uint64_t> content_hash;  // of that file, once it is complete
  size_t points = 0;                     // of this run, that is of its shard
  size_t done = 0, reused = 0;  // points that have a row; and of those the ones from an earlier session
  std::vector<Failure> failures;
  bool stopped = false;  // before the last point
  bool fresh = false;    // the run, or the one that it resumes, was told to start over
  std::vector<Session> sessions;
  ReferenceCounts references;  // of this session
};

// The manifest as JSON text: the config as it was resolved, all points of the sweep in frozen order, the
// program, its libraries, the machine, the scenes, and how the run went. Names no folder and no host.
std::string manifest_text(const Config& config, const FrozenSweep& sweep, const RunChoices& choices,
                          const RowOrigin& origin, const RunState& state);

// What resuming must know of a manifest.
struct EarlierManifest {
  std::string table;         // as in RunState
  std::string content_hash;  // 16 hexadecimal digits; empty while the table grows
  RowOrigin origin;
  std::vector<Session> sessions;
  bool fresh = false;
};

// None where there is no such file or it is not a manifest.
std::optional<EarlierManifest> read_manifest(const std::filesystem::path& file);

// Seconds of all sessions that have ended.
double total_wall_time_s(const std::vector<Session>& sessions);

}  // namespace hybray
