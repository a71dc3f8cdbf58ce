#include "core/base/error.h"
#include "harness/cli/commands.h"
#include "harness/cli/log.h"
#include "harness/config/parameter_rules.h"
#include "harness/gate/accept.h"
#include "harness/gate/gate_file.h"
#include "harness/gate/report.h"
#include "harness/gate/table_origin.h"
#include "harness/table/files.h"

#include <algorithm>
#include <fstream>
#include <set>

#include <fmt/format.h>

namespace hybray {
namespace {

namespace fs = std::filesystem;

// A table with all that it is held against.
struct Subject {
  GatedTable table;
  std::vector<Gate> gates;
  std::string gates_file;
  Baseline baseline;
  std::optional<int64_t> points;  // that it should have rows for
};

const Experiment* experiment_of(const Environment& environment, const fs::path& table,
                                const TableOrigin& origin) {
  if (const Experiment* found = find_experiment(origin.experiment, environment.experiments)) return found;
  throw InputError((table.parent_path() / "manifest.json").string(),
                   unknown_experiment(origin.experiment, environment.experiments));
}

// The file that holds the table's gates: the one that was named, or the config that the manifest names, in
// the present folder or among the project's.
fs::path gates_file(const Environment& environment, const CheckOptions& options, const fs::path& table,
                    const std::optional<TableOrigin>& origin) {
  if (options.gates) return *options.gates;
  if (!origin) {
    throw InputError(
        table.string(),
        "which config it is of is not known, since no manifest.json of it is beside it; name the config "
        "with --gates");
  }
  for (const fs::path& file : {fs::path(origin->config), environment.root / "configs" / origin->config}) {
    std::error_code error;
    if (fs::exists(file, error)) return file;
  }
  throw InputError(table.string(),
                   fmt::format("its config {} is neither here nor in {}; name it with --gates",
                               origin->config, (environment.root / "configs").string()));
}

Subject subject_of(const Environment& environment, const CheckOptions& options, const fs::path& file) {
  if (file.extension() != ".csv") throw InputError(file.string(), "expected a complete table, NAME.csv");
  const auto origin = find_origin(file);
  const Experiment* experiment = origin ? experiment_of(environment, file, *origin) : nullptr;
  const fs::path where = gates_file(environment, options, file, origin);
  GateFile gates = load_gates(where, environment.experiments, experiment);
  const fs::path folder =
      options.baseline ? fs::path(*options.baseline) : environment.root / "results" / "baseline";
  Baseline baseline{folder / file.filename(), {}};
  std::error_code error;
  if (fs::exists(baseline.file, error))
    baseline.table = GatedTable::accepted(baseline.file, *gates.experiment);
  return {GatedTable::of_run(file, *gates.experiment), std::move(gates.gates), where.string(),
          std::move(baseline), origin ? origin->points : std::nullopt};
}

// All that is wrong with any input is said before anything is checked or written.
std::vector<Subject> subjects_of(const Environment& environment, const CheckOptions& options) {
  std::vector<Subject> subjects;
  std::set<std::string> names;
  for (const std::string& table : options.tables) {
    if (!names.insert(fs::path(table).stem().string()).second)
      throw InputError(table,
                       "another table of this name is to be checked, which has the same accepted table");
    subjects.push_back(subject_of(environment, options, table));
  }
  return subjects;
}

// A table that lacks rows would pass gates for want of what they should have looked at.
std::optional<GateResult> lack_of_rows(const Subject& subject) {
  const size_t rows = subject.table.row_count();
  if (!subject.points || *subject.points == static_cast<int64_t>(rows)) return std::nullopt;
  GateResult result;
  result.name = result.words = "every point of the run has a row";
  result.status = GateStatus::missed;
  result.rows = rows;
  result.misses = {fmt::format("the run had {} points, the table has {} rows", *subject.points, rows)};
  return result;
}

TableReport check(const Subject& subject) {
  TableReport report{fs::path(subject.table.file()).stem().string(), subject.table.file(), {}, {}, {}};
  report.rows = subject.table.row_count();
  const std::vector<Gate> gates = subject.gates.empty() ? std::vector<Gate>{as_accepted()} : subject.gates;
  report.gates = (subject.gates.empty() ? "no gates in " : "gates of ") + subject.gates_file;
  if (std::any_of(gates.begin(), gates.end(), [](const Gate& gate) { return gate.baseline.has_value(); }))
    report.gates += ", accepted values of " + subject.baseline.file.string();
  if (auto lack = lack_of_rows(subject)) report.results.push_back(*std::move(lack));
  for (const Gate& gate : gates) report.results.push_back(evaluate(gate, subject.table, subject.baseline));
  return report;
}

// Whether reports go through `file` instead of replacing it: a pipe or a device.
bool is_stream(const fs::path& file) {
  std::error_code error;
  return fs::exists(file, error) && !fs::is_regular_file(file, error);
}

void prove_writable(const std::optional<std::string>& file) {
  if (!file || is_stream(*file)) return;
  const fs::path folder = fs::path(*file).parent_path();
  make_writable_folder(folder.empty() ? "." : folder);
}

void write_report(const std::optional<std::string>& file, const std::string& content) {
  if (!file) return;
  if (!is_stream(*file)) return replace_file(*file, content);
  if (!(std::ofstream(*file, std::ios::binary) << content << std::flush))
    throw RuntimeError(*file + ": cannot be written");
}

}  // namespace

int check_command(const Environment& environment, const CheckOptions& options) {
  const std::vector<Subject> subjects = subjects_of(environment, options);
  prove_writable(options.junit);
  prove_writable(options.markdown);
  std::vector<TableReport> reports;
  for (const Subject& subject : subjects) {
    if (!subject.points)
      log_warning(subject.table.file() + ": no manifest.json of it says how many rows it should have");
    reports.push_back(check(subject));
  }
  fmt::print("{}", text_report(reports));
  write_report(options.junit, junit_report(reports));
  write_report(options.markdown, markdown_report(reports));
  if (count_of(reports, GateStatus::unexpected_pass) > 0)
    log_warning("a gate that was expected to fail passes: take out its \"expected_failure\"");
  return count_of(reports, GateStatus::missed) > 0 ? kGateFailed : kOk;
}

int accept_command(const Environment& environment, const CheckOptions& options) {
  const std::vector<Subject> subjects = subjects_of(environment, options);
  std::vector<Acceptance> acceptances;
  for (const Subject& subject : subjects) {
    if (const auto lack = lack_of_rows(subject)) throw InputError(subject.table.file(), lack->misses.front());
    acceptances.push_back(prepare_acceptance(subject.table, subject.gates, subject.baseline));
  }
  for (size_t i = 0; i < subjects.size(); ++i) {
    const Baseline& before = subjects[i].baseline;
    make_writable_folder(before.file.parent_path().empty() ? "." : before.file.parent_path());
    for (const std::string& change : acceptances[i].changes) fmt::print("{}\n", change);
    const std::string what = before.table
                                 ? fmt::format("{} differences, {} cells moved within their tolerance",
                                               acceptances[i].changes.size(), acceptances[i].moved)
                                 : std::string("nothing was accepted before");
    fmt::print("{} -> {}: {}\n", subjects[i].table.file(), before.file.string(), what);
    replace_file(before.file, acceptances[i].csv);
  }
  return kOk;
}

}  // namespace hybray
