#include "harness/gate/report.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace hybray {
namespace {

// Text in a cell or a line, shown as it is.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += ' ';
    else if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (std::string_view("\\`*_{}[]()#+!|~").find(c) != std::string_view::npos)
      result += std::string("\\") + c;
    else
      result += c;
  }
  return result;
}

const char* sign(GateStatus status) {
  switch (status) {
    case GateStatus::passed:
      return "✅ passed";
    case GateStatus::missed:
      return "❌ **missed**";
    case GateStatus::expected_failure:
      return "⚠️ expected failure";
    case GateStatus::unexpected_pass:
      return "⚠️ unexpected pass";
  }
  return "";
}

std::string details(const GateResult& result) {
  constexpr size_t kMost = 20;  // lines; the text report has all
  std::string text = fmt::format("\n**{}**: {}\n\n", escaped(result.name), escaped(result.words));
  if (!result.reason.empty()) text += fmt::format("- because: {}\n", escaped(result.reason));
  if (!result.expected_failure.empty())
    text += fmt::format("- expected: {}\n", escaped(result.expected_failure));
  for (size_t i = 0; i < std::min(kMost, result.misses.size()); ++i)
    text += fmt::format("- {}\n", escaped(result.misses[i]));
  if (result.misses.size() > kMost) text += fmt::format("- and {} more\n", result.misses.size() - kMost);
  return text;
}

}  // namespace

std::string markdown_report(std::span<const TableReport> reports) {
  std::string text = fmt::format("## hybray check\n\n{}\n", escaped(summary(reports)));
  for (const TableReport& report : reports) {
    text +=
        fmt::format("\n### {}\n\n{} rows, {}\n\n", escaped(report.name), report.rows, escaped(report.gates));
    text += "| result | gate | rows | value | limit | margin | where |\n|---|---|---:|---:|---:|---:|---|\n";
    for (const GateResult& r : report.results) {
      text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", sign(r.status), escaped(r.name), r.rows,
                          escaped(r.value), escaped(r.limit), escaped(r.margin), escaped(r.row));
    }
    for (const GateResult& result : report.results) {
      if (result.status != GateStatus::passed) text += details(result);
    }
  }
  return text;
}

}  // namespace hybray
