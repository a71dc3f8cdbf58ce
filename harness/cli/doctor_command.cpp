// `hybray doctor`: what this program runs on, what would make its numbers wander, what is missing, and the
// command that mends it.
#include "core/base/lanes.h"
#include "core/base/parallel.h"
#include "core/tracer/tracer.h"
#include "harness/cli/commands.h"
#include "harness/sweep/memory.h"
#include "harness/table/build_info.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

namespace hybray {
namespace {

namespace fs = std::filesystem;

enum class Finding { good, note, missing };

// One line of the report, and below it the command that mends what it found.
void say(Finding finding, const std::string& subject, const std::string& text,
         const std::string& remedy = {}) {
  constexpr std::array<const char*, 3> kMarks{"ok", "note", "missing"};
  fmt::print("{:<8} {:<14} {}\n", kMarks[static_cast<size_t>(finding)], subject, text);
  if (!remedy.empty()) fmt::print("{:<8} {:<14} -> {}\n", "", "", remedy);
}

std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

void report_program() {
  const BuildInfo build = build_info();
  say(build.build_type == "Release" ? Finding::good : Finding::note, "program",
      fmt::format("{}, {} build, {}", version_line(), build.build_type, build.compiler),
      build.build_type == "Release" ? "" : "times need a release build: scripts/build.sh release");
  say(Finding::good, "Embree", embree_version());
  say(Finding::good, "vector code",
      fmt::format("{} of {}", lanes_target(), fmt::join(lanes_targets(), ", ")));
}

void report_processor() {
  const MachineInfo machine = machine_info();
  say(Finding::good, "processor",
      fmt::format("{}, {} hardware threads ({})", machine.cpu, machine.hardware_threads,
                  fmt::join(machine.features, " ")));
  const int threads = thread_count();
  say(threads < machine.hardware_threads ? Finding::note : Finding::good, "threads",
      fmt::format("{} will be used", threads));

  const std::string governor = first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  if (governor.empty())
    say(Finding::note, "frequency", "the system does not show how it is scaled, as in most virtual machines");
  else if (governor == "performance")
    say(Finding::good, "frequency", "governor \"performance\"");
  else
    say(Finding::note, "frequency", fmt::format("governor \"{}\": times will wander with it", governor),
        "cpupower frequency-set -g performance");

  double load = 0.0;
  if (getloadavg(&load, 1) == 1) {
    // Half a processor's worth of other work already shows in the spread of the times.
    const bool busy = load > 0.5;
    say(busy ? Finding::note : Finding::good, "load",
        fmt::format("{:.1f} over the last minute{}", load,
                    busy ? ": other work is running, and absolute times will wander; ratios less" : ""));
  }
}

void report_memory() {
  say(Finding::good, "memory",
      fmt::format("{} in all, {} available", format_bytes(machine_info().memory_bytes),
                  format_bytes(available_memory_bytes())));
}

// Returns whether results can be written.
bool report_results(const fs::path& root) {
  const fs::path results = root / "results";
  std::error_code error;
  const fs::space_info space = fs::space(fs::exists(results) ? results : root, error);
  const bool writable = access((fs::exists(results) ? results : root).c_str(), W_OK) == 0;
  if (!writable) {
    say(Finding::missing, "results", fmt::format("{} cannot be written to", results.string()),
        "hybray run CONFIG -o FOLDER");
    return false;
  }
  const double free_bytes = error ? 0.0 : static_cast<double>(space.available);
  constexpr double kPlenty = 1e9;  // tables are small, pictures and cached references are not
  say(free_bytes < kPlenty ? Finding::note : Finding::good, "results",
      fmt::format("{}, {} free", results.string(), format_bytes(free_bytes)));
  return true;
}

// Returns whether every scene that has no outside source is there.
bool report_scenes(const ScenePaths& paths) {
  std::vector<std::string> available, missing;
  bool good = true;
  for (const SceneEntry& scene : list_scenes(paths)) {
    if (scene.state == SceneState::available) available.push_back(scene.name);
    if (scene.state == SceneState::source_missing) missing.push_back(scene.name);
    if (scene.state == SceneState::unknown) {
      say(Finding::missing, "scene", fmt::format("{}: {}", scene.name, scene.source));
      good = false;
    }
  }
  if (available.empty()) {
    say(Finding::missing, "scenes", "none is found", "run inside the project's folder, or set HYBRAY_ROOT");
    return false;
  }
  say(Finding::good, "scenes", fmt::format("{} found: {}", available.size(), fmt::join(available, " ")));
  if (!missing.empty())
    say(Finding::note, "scenes",
        fmt::format("{} without their source, left out of runs that call them optional: {}", missing.size(),
                    fmt::join(missing, " ")),
        "scripts/fetch_scenes.py, or name their folder in HYBRAY_SCENE_PATH");
  return good;
}

void report_python() {
  constexpr const char* kModules[] = {"matplotlib", "jinja2", "PIL"};
  std::vector<std::string> missing;
  if (access("/usr/bin/python3", X_OK) != 0) {
    say(Finding::missing, "python", "/usr/bin/python3 is not there: no figures, no report",
        "scripts/setup.sh");
    return;
  }
  for (const char* module : kModules) {
    const std::string command = fmt::format("/usr/bin/python3 -c 'import {}' >/dev/null 2>&1", module);
    if (std::system(command.c_str()) != 0) missing.emplace_back(module);
  }
  if (missing.empty())
    say(Finding::good, "python", "figures and report have what they need");
  else
    say(Finding::missing, "python", fmt::format("figures and report lack {}", fmt::join(missing, ", ")),
        "scripts/setup.sh");
}

}  // namespace

int doctor_command(const Environment& environment) {
  report_program();
  report_processor();
  report_memory();
  const bool writable = report_results(environment.root);
  const bool scenes = report_scenes(environment.scene_paths);
  report_python();
  return writable && scenes ? kOk : kUsage;
}

}  // namespace hybray
