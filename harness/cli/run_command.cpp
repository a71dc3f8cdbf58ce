#include "core/base/error.h"
#include "core/base/parallel.h"
#include "harness/cli/commands.h"
#include "harness/cli/log.h"
#include "harness/cli/progress.h"
#include "harness/sweep/interrupt.h"
#include "harness/sweep/manifest.h"
#include "harness/sweep/memory.h"
#include "harness/sweep/run_sweep.h"
#include "harness/table/files.h"

#include <fmt/format.h>

namespace hybray {
namespace {

// One config, ready to run.
struct Job {
  Config config;
  FrozenSweep sweep;
  std::filesystem::path folder;
};

std::filesystem::path output_folder(const Environment& environment, const RunOptions& options,
                                    const Config& config) {
  if (!options.output) return environment.root / "results" / "out" / config.name;
  const std::filesystem::path folder(*options.output);
  return options.configs.size() == 1 ? folder : folder / config.name;
}

// Loads, checks and freezes every config, and proves that their folders can be written to, before any work
// begins.
std::vector<Job> prepare(const Environment& environment, const RunOptions& options) {
  std::vector<Job> jobs;
  SceneCatalog scenes(environment.scene_paths);
  for (const std::string& file : options.configs) {
    Config config = load_config(file, environment.experiments, options.assignments);
    const std::filesystem::path folder = output_folder(environment, options, config);
    for (const Job& other : jobs) {
      if (other.folder == folder) {
        throw InputError(file, fmt::format("it would write to the same folder as {}: {}",
                                           other.config.file.string(), folder.string()));
      }
    }
    jobs.push_back({std::move(config), {}, folder});
  }
  for (Job& job : jobs) job.sweep = freeze(job.config, scenes, {options.filters, available_memory_bytes()});
  for (const Job& job : jobs) {
    if (!job.sweep.points.empty()) make_writable_folder(job.folder);
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

RunObserver observe(const Job& job, Progress& progress, const InterruptGuard& guard) {
  const auto label = [&job](const Point& point) { return point_label(job.config, point); };
  return {[&progress, label](size_t i, const Point& point) { progress.point_starts(i, label(point)); },
          [&progress, label](size_t i, const Point& point) { progress.point_done(i, label(point)); },
          [&progress, &job](size_t, const Point& point, const std::string& message) {
            progress.clear();
            log_error(fmt::format("point {} ({}) failed: {}", point.id, point_label(job.config, point, true),
                                  message));
          },
          [&guard] { return guard.interrupted(); }};
}

// Beside the table; that of a stopped run under another name, so that an earlier complete table keeps its
// own.
void write_manifest(const Job& job, const RunResult& result, const RunChoices& choices) {
  const std::filesystem::path complete = job.folder / "manifest.json",
                              partial = job.folder / "manifest.json.partial";
  replace_file(result.stopped ? partial : complete, manifest_text(job.config, job.sweep, result, choices));
  std::error_code ignored;
  if (!result.stopped) std::filesystem::remove(partial, ignored);
}

int run_job(const Environment& environment, const RunOptions& options, const Job& job,
            const InterruptGuard& guard) {
  report_skipped(job.sweep);
  if (job.sweep.points.empty()) {
    log_warning(job.config.file.string() + ": nothing is left to run, and nothing is written");
    return kOk;
  }
  Workspace workspace({environment.scene_paths, job.folder, static_cast<uint64_t>(job.config.seed),
                       options.timing, options.threads});
  std::vector<double> costs;
  for (const Point& point : job.sweep.points) {
    costs.push_back(job.config.experiment->cost_seconds ? job.config.experiment->cost_seconds(point) : 1.0);
  }
  Progress progress(job.config.name, costs, options.quiet);
  const RunResult result = run_sweep(job.config, job.sweep, workspace, observe(job, progress, guard));
  progress.clear();

  const std::string summary = fmt::format("{}: {} of {} points in {}", job.config.name, result.done,
                                          job.sweep.points.size(), format_duration(result.wall_seconds));
  if (result.done > 0) {
    const RunChoices choices{options.assignments, options.filters, options.timing, thread_count()};
    write_manifest(job, result, choices);
    log_info(fmt::format("{} -> {}", summary, result.table.string()));
  }
  if (result.failed > 0) log_error(fmt::format("{}; {} failed", summary, result.failed));
  if (result.stopped) {
    log_warning(fmt::format("interrupted; {}", result.done > 0
                                                   ? "the rows so far are in " + result.table.string()
                                                   : "no point was done"));
    return kInterrupted;
  }
  return result.failed > 0 ? kSomeFailed : kOk;
}

}  // namespace

int run_command(const Environment& environment, const RunOptions& options) {
  const ThreadLimit limit(options.threads);
  const std::vector<Job> jobs = prepare(environment, options);
  const InterruptGuard guard;
  int worst = kOk;
  for (const Job& job : jobs) {
    worst = std::max(worst, run_job(environment, options, job, guard));
    if (worst == kInterrupted) break;
  }
  return worst;
}

}  // namespace hybray
