#include "harness/gate/report.h"
#include "harness/table/text_table.h"

#include <algorithm>

#include <fmt/format.h>

namespace hybray {
namespace {

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return text;
}

void add_details(std::string& text, const GateResult& result) {
  if (result.status == GateStatus::passed) return;
  text += fmt::format("\n{}: {}\n", label(result.status), one_line(result.name));
  if (result.words != result.name) text += fmt::format("  asks for: {}\n", one_line(result.words));
  if (!result.reason.empty()) text += fmt::format("  because: {}\n", one_line(result.reason));
  if (!result.expected_failure.empty())
    text += fmt::format("  expected: {}\n", one_line(result.expected_failure));
  for (const std::string& miss : result.misses) text += fmt::format("  {}\n", one_line(miss));
}

}  // namespace

const char* label(GateStatus status) {
  switch (status) {
    case GateStatus::passed:
      return "passed";
    case GateStatus::missed:
      return "MISSED";
    case GateStatus::expected_failure:
      return "expected failure";
    case GateStatus::unexpected_pass:
      return "unexpected pass";
  }
  return "";
}

size_t count_of(std::span<const TableReport> reports, GateStatus status) {
  size_t count = 0;
  for (const TableReport& report : reports) {
    const auto is_it = [&](const GateResult& result) { return result.status == status; };
    count += static_cast<size_t>(std::count_if(report.results.begin(), report.results.end(), is_it));
  }
  return count;
}

std::string summary(std::span<const TableReport> reports) {
  size_t all = 0;
  for (const TableReport& report : reports) all += report.results.size();
  std::string text =
      fmt::format("{} gate{}: {} passed", all, all == 1 ? "" : "s", count_of(reports, GateStatus::passed));
  const auto add = [&](GateStatus status, const char* one, const char* many) {
    const size_t count = count_of(reports, status);
    if (count > 0) text += fmt::format(", {} {}", count, count == 1 ? one : many);
  };
  add(GateStatus::missed, "missed", "missed");
  add(GateStatus::expected_failure, "expected failure", "expected failures");
  add(GateStatus::unexpected_pass, "unexpected pass", "unexpected passes");
  return text;
}

std::string text_report(std::span<const TableReport> reports) {
  std::string text;
  for (const TableReport& report : reports) {
    text += fmt::format("{}: {} rows, {}\n", report.file, report.rows, report.gates);
    TextTable lines{{"result", "gate", "rows", "value", "limit", "margin", "where"}};
    for (const GateResult& r : report.results) {
      lines.push_back({label(r.status), one_line(r.name), fmt::format("{}", r.rows), r.value, r.limit,
                       r.margin, one_line(r.row)});
    }
    text += aligned_table(lines);
    for (const GateResult& result : report.results) add_details(text, result);
    text += '\n';
  }
  return text + summary(reports) + '\n';
}

}  // namespace hybray
