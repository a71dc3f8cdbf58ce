#include "core/base/error.h"
#include "harness/cli/commands.h"
#include "harness/config/parameter_rules.h"
#include "harness/config/schema.h"
#include "harness/gate/gate_schema.h"
#include "harness/table/text_table.h"

#include <fmt/format.h>

namespace hybray {
namespace {

const char* label(ColumnKind kind) {
  switch (kind) {
    case ColumnKind::key:
      return "key";
    case ColumnKind::metric:
      return "metric";
    case ColumnKind::time:
      return "time";
    case ColumnKind::count:
      return "count";
  }
  return "";
}

const char* label(Better better) {
  switch (better) {
    case Better::none:
      return "";
    case Better::lower:
      return "lower";
    case Better::higher:
      return "higher";
  }
  return "";
}

// How `hybray check` holds the column against accepted tables.
std::string comparison_words(const Column& column) {
  switch (comparison_of(column)) {
    case Comparison::identity:
      return "row";
    case Comparison::none:
      return "";
    case Comparison::value:
      break;
  }
  const auto [absolute, relative] = column.tolerance;
  std::string words;
  if (absolute > 0) words += fmt::format("+-{}", absolute);
  if (relative > 0) words += fmt::format("{}+-{} of it", words.empty() ? "" : " ", relative);
  return words.empty() ? "exact" : words;
}

TextTable parameter_table(const Experiment& experiment) {
  TextTable table{{"parameter", "unit", "default", "accepts", "meaning"}};
  for (const Parameter& p : experiment.parameters) {
    const bool required = std::holds_alternative<std::monostate>(p.default_value);
    table.push_back(
        {p.name, p.unit, required ? "(required)" : to_text(p.default_value), expectation(p), p.text});
  }
  return table;
}

TextTable column_table(const Experiment& experiment) {
  TextTable table{{"column", "unit", "kind", "better", "accepted", "meaning"}};
  table.push_back(
      {"id", "", "key", "", "", "Id of the point: a hash of its parameters, the seed and the scene."});
  for (const Column& c : experiment.columns)
    table.push_back({c.name, c.unit, label(c.kind), label(c.better), comparison_words(c), c.text});
  return table;
}

// GitHub's Markdown; the first row is the head.
std::string markdown_table(const TextTable& table) {
  std::string text;
  for (size_t r = 0; r < table.size(); ++r) {
    text += "|";
    for (const std::string& cell : table[r]) {
      std::string escaped;
      for (const char c : cell) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
      text += " " + escaped + " |";
    }
    text += '\n';
    if (r > 0) continue;
    text += "|";
    for (size_t i = 0; i < table[r].size(); ++i) text += "---|";
    text += '\n';
  }
  return text;
}

}  // namespace

int describe_command(const Environment& environment, const DescribeOptions& options) {
  if (options.format == DescribeFormat::gate_schema) {
    if (!options.experiment.empty()) throw InputError("--gate-schema", "it is of all experiments; name none");
    fmt::print("{}", gate_file_schema_text(environment.experiments));
    return kOk;
  }
  if (options.experiment.empty()) {
    if (options.format == DescribeFormat::schema) throw InputError("--schema", "name the experiment");
    for (const Experiment& e : environment.experiments) fmt::print("{}  {}\n", e.name, e.text);
    return kOk;
  }
  if (options.experiment == "suite") {
    if (options.format == DescribeFormat::schema)
      fmt::print("{}", suite_schema_text());
    else
      fmt::print("suite\nConfigs that are run together, each with changes of its own; see --schema.\n");
    return kOk;
  }
  const Experiment* experiment = find_experiment(options.experiment, environment.experiments);
  if (!experiment)
    throw InputError("describe", unknown_experiment(options.experiment, environment.experiments));
  if (options.format == DescribeFormat::schema) {
    fmt::print("{}", config_schema_text(*experiment));
    return kOk;
  }
  const bool markdown = options.format == DescribeFormat::markdown;
  const auto print = [&](const TextTable& table) {
    fmt::print("{}", markdown ? markdown_table(table) : aligned_table(table));
  };
  fmt::print("{}{}\n{}\n\n", markdown ? "## " : "", experiment->name, experiment->text);
  print(parameter_table(*experiment));
  fmt::print("\n");
  print(column_table(*experiment));
  return kOk;
}

}  // namespace hybray
