#include "harness/gate/report.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace hybray {
namespace {

// Length of the UTF-8 sequence that begins here and is a character of XML 1.0; 0: there is none.
size_t xml_character(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return first >= 0x20 || first == '\t' || first == '\n' || first == '\r' ? 1 : 0;
  const size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || length > text.size()) return 0;
  char32_t code = first & (0xff >> (length + 1));
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3f);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  const bool forbidden = code == 0xfffe || code == 0xffff || code > 0x10ffff;
  return overlong || surrogate || forbidden ? 0 : length;
}

// Text for an attribute or an element.
std::string escaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const size_t length = xml_character(text);
    const char c = text.front();
    if (length == 0)
      result += "\xef\xbf\xbd";  // U+FFFD
    else if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '\n' || c == '\r' || c == '\t')
      result += fmt::format("&#{};", static_cast<int>(c));  // kept as it is in attributes too
    else
      result += text.substr(0, length);
    text.remove_prefix(std::max<size_t>(length, 1));
  }
  return result;
}

std::string details(const GateResult& result) {
  std::string text = result.words;
  if (!result.reason.empty()) text += "\nbecause: " + result.reason;
  for (const std::string& miss : result.misses) text += '\n' + miss;
  return escaped(text);
}

std::string test_case(const TableReport& report, const GateResult& result) {
  std::string inner;
  const std::string margin =
      fmt::format("{} {} margin {} at {}", result.value, result.limit, result.margin, result.row);
  switch (result.status) {
    case GateStatus::passed:
      if (!result.value.empty()) inner = fmt::format("<system-out>{}</system-out>", escaped(margin));
      break;
    case GateStatus::missed:
      inner = fmt::format("<failure type=\"gate\" message=\"{}\">{}</failure>",
                          escaped(result.misses.front()), details(result));
      break;
    case GateStatus::expected_failure:
      inner = fmt::format("<skipped message=\"{}\"/><system-out>{}</system-out>",
                          escaped("expected failure: " + result.expected_failure), details(result));
      break;
    case GateStatus::unexpected_pass:
      inner = fmt::format("<system-out>{}</system-out>",
                          escaped("unexpected pass; expected to fail: " + result.expected_failure));
      break;
  }
  return fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"0\">{}</testcase>\n",
                     escaped("hybray." + report.name), escaped(result.name), inner);
}

std::string counts(std::span<const TableReport> reports) {
  size_t tests = 0;
  for (const TableReport& report : reports) tests += report.results.size();
  return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\" time=\"0\"", tests,
                     count_of(reports, GateStatus::missed), count_of(reports, GateStatus::expected_failure));
}

}  // namespace

std::string junit_report(std::span<const TableReport> reports) {
  size_t tests = 0;
  for (const TableReport& report : reports) tests += report.results.size();
  // The outermost element has no "skipped" in the schema that Jenkins' plug-in is checked with.
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"hybray check\" tests=\"{}\" "
      "failures=\"{}\" "
      "errors=\"0\" time=\"0\">\n",
      tests, count_of(reports, GateStatus::missed));
  for (const TableReport& report : reports) {
    xml += fmt::format("  <testsuite name=\"{}\" {}>\n", escaped(report.name), counts({&report, 1}));
    for (const GateResult& result : report.results) xml += test_case(report, result);
    xml += "  </testsuite>\n";
  }
  return xml + "</testsuites>\n";
}

}  // namespace hybray
