#include "core/base/error.h"
#include "core/base/parallel.h"
#include "harness/cli/commands.h"
#include "harness/cli/log.h"
#include "harness/cli/progress.h"
#include "harness/sweep/interrupt.h"
#include "harness/sweep/memory.h"
#include "harness/sweep/plan.h"
#include "harness/sweep/run_sweep.h"
#include "harness/sweep/shard.h"
#include "harness/table/files.h"
#include "harness/table/folder_lock.h"
#include "harness/table/growing_table.h"

#include <algorithm>
#include <functional>
#include <optional>

#include <fmt/format.h>

namespace hybray {
namespace {

// One config, ready to run.
struct Job : PlannedConfig {
  std::filesystem::path folder;
  std::vector<Point> points;       // of the sweep, or of its shard
  std::optional<FolderLock> lock;  // of the folder
};

std::filesystem::path output_folder(const Environment& environment, const RunOptions& options,
                                    const Config& config, bool is_single) {
  std::filesystem::path folder = environment.root / "results" / "out" / config.name;
  if (options.output) {
    folder = *options.output;
    if (!is_single) folder /= config.name;
  }
  if (options.shard.empty()) return folder;
  const Shard shard = parse_shard(options.shard);
  return folder / fmt::format("shard-{}-of-{}", shard.index, shard.count);
}

// Makes the job's folder its own, and proves that its table will fit into it.
void take_folder(Job& job) {
  const size_t table = estimated_table_bytes(job.config.experiment->columns, job.points.size());
  constexpr size_t kManifest = 16384, kId = 24;  // bytes, without and for each point
  make_writable_folder(job.folder, 2 * table + kManifest + kId * job.sweep.points.size());
  job.lock.emplace(job.folder);
  remove_unfinished_files(job.folder);
  check_folder_is_free_for(job.folder, job.config.name);
}

// Loads, checks and freezes every config, and takes their folders, before any work begins.
std::vector<Job> prepare(const Environment& environment, const RunOptions& options) {
  std::vector<Job> jobs;
  SceneCatalog scenes(environment.scene_paths);
  Plan plan = make_plan({options.configs, options.assignments, options.filters, available_memory_bytes()},
                        environment.experiments, scenes);
  for (PlannedConfig& planned : plan.configs) {
    const std::filesystem::path folder = output_folder(environment, options, planned.config, plan.is_single);
    for (const Job& other : jobs) {
      if (other.folder == folder) {
        throw InputError(planned.config.file.string(),
                         fmt::format("it would write to the same folder as {}: {}",
                                     other.config.file.string(), folder.string()));
      }
    }
    Job job{std::move(planned), folder, {}, {}};
    job.points = options.shard.empty()
                     ? job.sweep.points
                     : points_of_shard(*job.config.experiment, job.sweep, parse_shard(options.shard));
    jobs.push_back(std::move(job));
  }
  for (Job& job : jobs) {
    if (!job.sweep.points.empty()) take_folder(job);
  }
  return jobs;
}

void report_skipped(const FrozenSweep& sweep) {
  for (const SkippedScene& skipped : sweep.skipped) {
    log_warning(fmt::format("the optional scene \"{}\" is left out, since its source is missing: {} points{}",
                            skipped.scene, skipped.points,
                            skipped.for_each_camera ? " for each of its cameras" : ""));
  }
}

// Tells people on stderr how a job goes.
class Reporter {
 public:
  Reporter(const Job& job, bool quiet) : job_(job), quiet_(quiet) {}
  ~Reporter() { clear(); }
  Reporter(const Reporter&) = delete;
  Reporter& operator=(const Reporter&) = delete;

  RunObserver observer(const InterruptGuard& guard) {
    return {[this](const auto& to_do, const RunRecord& record) { start(to_do, record); },
            [this](size_t i, const Point& point) { progress_->point_starts(i, label(point)); },
            [this](size_t i, const Point& point) { progress_->point_done(i, label(point)); },
            [this](size_t, const Point& point, const std::string& message) {
              clear();
              log_error(fmt::format("point {} ({}) failed: {}", point.id,
                                    point_label(job_.config, point, true), message));
            },
            [&guard] { return guard.interrupted(); }};
  }

  void clear() {
    if (progress_) progress_->clear();
  }

 private:
  std::string label(const Point& point) const { return point_label(job_.config, point); }

  void start(const std::vector<const Point*>& to_do, const RunRecord& record) {
    for (const std::string& remark : record.remarks()) log_warning(remark);
    if (record.reused() > 0) {
      log_info(fmt::format("{}: {} of {} points are there already", job_.config.name, record.reused(),
                           job_.points.size()));
    }
    FrozenSweep left;
    left.scenes = job_.sweep.scenes;
    for (const Point* point : to_do) left.points.push_back(*point);
    progress_.emplace(job_.config.name, estimated_seconds(*job_.config.experiment, left), quiet_);
  }

  const Job& job_;
  bool quiet_;
  std::optional<Progress> progress_;
};

// The cache of all jobs; its messages take the progress line away.
struct RunCache {
  RunCache(const Environment& environment, const RunOptions& options) {
    if (!options.use_cache || options.cache.max_bytes == 0) return;
    const auto clear = [this] {
      if (clear_progress) clear_progress();
    };
    cache.emplace(ReferenceCache::Settings{cache_folder(environment, options.cache), options.cache.max_bytes,
                                           [clear](const std::string& text) { clear(), log_warning(text); },
                                           [clear](const std::string& text) { clear(), log_info(text); }});
  }
  RunCache(const RunCache&) = delete;
  RunCache& operator=(const RunCache&) = delete;

  ReferenceCache* get() { return cache ? &*cache : nullptr; }

  std::optional<ReferenceCache> cache;
  std::function<void()> clear_progress;  // of the job at hand
};

int run_job(const Environment& environment, const RunOptions& options, const Job& job,
            const InterruptGuard& guard, RunCache& cache) {
  report_skipped(job.sweep);
  if (job.sweep.points.empty() && job.sweep.skipped.empty()) {
    log_info(job.config.name + ": no point matches the filters");
    return kOk;
  }
  if (job.sweep.points.empty()) {
    log_warning(job.config.file.string() + ": nothing is left to run, and nothing is written");
    return kOk;
  }
  Workspace workspace({environment.scene_paths, job.folder, static_cast<uint64_t>(job.config.seed),
                       options.timing, cache.get()});
  RunRequest request{job.config, job.sweep, job.points, {}};
  request.choices = {job.assignments, job.filters,           options.timing, thread_count(), {},
                     options.fresh,   cache.get() != nullptr};
  if (!options.shard.empty()) request.choices.shard = parse_shard(options.shard);
  Reporter reporter(job, options.quiet);
  cache.clear_progress = [&reporter] { reporter.clear(); };
  const RunResult result = run_sweep(request, workspace, reporter.observer(guard));
  cache.clear_progress = nullptr;
  reporter.clear();

  const std::string summary = fmt::format("{}: {} of {} points in {}", job.config.name, result.done,
                                          job.points.size(), format_duration(result.wall_seconds));
  if (result.done > 0) log_info(fmt::format("{} -> {}", summary, result.table.string()));
  if (job.points.empty())
    log_info(fmt::format("{}: no point is in shard {}", job.config.name, options.shard));
  if (result.failed > 0)
    log_error(fmt::format("{}; {} failed; the same command tries them again", summary, result.failed));
  if (result.stopped) {
    log_warning(fmt::format("interrupted; {}", result.done > 0
                                                   ? "the rows so far are in " + result.table.string() +
                                                         ", and the same command goes on from there"
                                                   : "no point was done"));
    return kInterrupted;
  }
  return result.failed > 0 ? kSomeFailed : kOk;
}

}  // namespace

int run_command(const Environment& environment, const RunOptions& options) {
  const ThreadLimit limit(options.threads);
  const InterruptGuard guard;
  const std::vector<Job> jobs = prepare(environment, options);
  RunCache cache(environment, options);
  int worst = kOk;
  for (const Job& job : jobs) {
    if (guard.interrupted()) return kInterrupted;
    worst = std::max(worst, run_job(environment, options, job, guard, cache));
    if (worst == kInterrupted) break;
  }
  return worst;
}

}  // namespace hybray
