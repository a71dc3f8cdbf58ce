#include "harness/gate/report.h"

#include "tests/harness/support/child_process.h"
#include "tests/temporary_folder.h"

#include <sstream>

#include <gtest/gtest.h>

namespace hybray {
namespace {

GateResult result(const std::string& name, GateStatus status) {
  GateResult r;
  r.name = name;
  r.words = "alpha >= 0.5";
  r.status = status;
  r.rows = 2;
  r.value = "0.25";
  r.limit = ">= 0.5";
  r.margin = "-0.25";
  r.row = "scene=a";
  if (status == GateStatus::missed || status == GateStatus::expected_failure) r.misses = {"scene=a: too low"};
  if (status == GateStatus::expected_failure || status == GateStatus::unexpected_pass)
    r.expected_failure = "known";
  return r;
}

std::vector<TableReport> one_of_each() {
  return {{"t",
           "out/t.csv",
           "gates of t.json",
           2,
           {result("good", GateStatus::passed), result("bad", GateStatus::missed),
            result("known", GateStatus::expected_failure), result("better", GateStatus::unexpected_pass)}}};
}

// What a parser of another make reads: a line for each element with its attributes and text.
std::string parsed(const std::string& xml) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("junit.xml", xml);
  const char* script =
      "import sys, xml.etree.ElementTree as e\n"
      "for x in e.parse(sys.argv[1]).iter(): print(x.tag, sorted(x.attrib.items()), ascii((x.text or "
      "'').strip()))\n";
  const test::Outcome outcome = test::run_process({"/usr/bin/python3", "-c", script, file.string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err << xml;
  return outcome.out;
}

TEST(TextReport, AlignsItsColumnsAndExplainsWhatDidNotPass) {
  EXPECT_EQ(text_report(one_of_each()), R"(out/t.csv: 2 rows, gates of t.json
result            gate    rows  value  limit   margin  where
passed            good    2     0.25   >= 0.5  -0.25   scene=a
MISSED            bad     2     0.25   >= 0.5  -0.25   scene=a
expected failure  known   2     0.25   >= 0.5  -0.25   scene=a
unexpected pass   better  2     0.25   >= 0.5  -0.25   scene=a

MISSED: bad
  asks for: alpha >= 0.5
  scene=a: too low

expected failure: known
  asks for: alpha >= 0.5
  expected: known
  scene=a: too low

unexpected pass: better
  asks for: alpha >= 0.5
  expected: known

4 gates: 1 passed, 1 missed, 1 expected failure, 1 unexpected pass
)");
}

TEST(TextReport, CountsCharactersNotBytesAndKeepsToOneLine) {
  std::vector<TableReport> reports = one_of_each();
  reports[0].results = {result("größer\n\x1b[31m", GateStatus::passed), result("ab", GateStatus::passed)};
  const std::string text = text_report(reports);
  EXPECT_NE(text.find("passed  größer  [31m  2     0.25"), std::string::npos) << text;
  EXPECT_NE(text.find("passed  ab            2     0.25"), std::string::npos) << text;
}

TEST(JunitReport, CountsAndNamesWhatFailed) {
  const std::string xml = parsed(junit_report(one_of_each()));
  EXPECT_EQ(
      xml,
      R"(testsuites [('errors', '0'), ('failures', '1'), ('name', 'hybray check'), ('tests', '4'), ('time', '0')] ''
testsuite [('errors', '0'), ('failures', '1'), ('name', 't'), ('skipped', '1'), ('tests', '4'), ('time', '0')] ''
testcase [('classname', 'hybray.t'), ('name', 'good'), ('time', '0')] ''
system-out [] '0.25 >= 0.5 margin -0.25 at scene=a'
testcase [('classname', 'hybray.t'), ('name', 'bad'), ('time', '0')] ''
failure [('message', 'scene=a: too low'), ('type', 'gate')] 'alpha >= 0.5\nscene=a: too low'
testcase [('classname', 'hybray.t'), ('name', 'known'), ('time', '0')] ''
skipped [('message', 'expected failure: known')] ''
system-out [] 'alpha >= 0.5\nscene=a: too low'
testcase [('classname', 'hybray.t'), ('name', 'better'), ('time', '0')] ''
system-out [] 'unexpected pass; expected to fail: known'
)");
}

TEST(JunitReport, EscapesEveryText) {
  std::vector<TableReport> reports = one_of_each();
  const std::string nasty = "<a href=\"x\">&amp; ]]> 'q' \n\t|é|\U0001F600|";
  reports[0].results = {result(nasty, GateStatus::missed)};
  reports[0].results[0].misses = {nasty};
  const std::string xml = parsed(junit_report(reports));
  const std::string read = "'<a href=\"x\">&amp; ]]> \\'q\\' \\n\\t|\xc3\xa9|\xf0\x9f\x98\x80|'";
  EXPECT_NE(xml.find("('name', " + read), std::string::npos) << xml;
  EXPECT_NE(xml.find("('message', " + read), std::string::npos) << xml;
}

TEST(JunitReport, ReplacesWhatXmlCannotHold) {
  std::vector<TableReport> reports = one_of_each();
  // A null, a bell, a byte that is no UTF-8, a cut-off and an overlong sequence, a surrogate, U+FFFE.
  using namespace std::string_literals;
  const std::string broken = "\0|\a|\xff|\xe2\x82|\xc0\xaf|\xed\xa0\x80|\xef\xbf\xbe|ok"s;
  reports[0].results = {result(broken, GateStatus::passed)};
  const std::string xml = parsed(junit_report(reports));
  std::string r = "\xef\xbf\xbd";
  EXPECT_NE(xml.find("('name', '" + r + "|" + r + "|" + r + "|" + r + r + "|" + r + r + "|" + r + r + r +
                     "|" + r + r + r + "|ok')"),
            std::string::npos)
      << xml;
}

TEST(MarkdownReport, IsATableThatNoTextBreaks) {
  std::vector<TableReport> reports = one_of_each();
  reports[0].results.push_back(result("a|b\n<script>*x*", GateStatus::missed));
  const std::string text = markdown_report(reports);
  EXPECT_NE(text.find("| ✅ passed | good | 2 | 0.25 | &gt;= 0.5 | -0.25 | scene=a |"), std::string::npos)
      << text;
  EXPECT_NE(text.find("a\\|b &lt;script&gt;\\*x\\*"), std::string::npos) << text;
  EXPECT_EQ(text.find("<script>"), std::string::npos);
  EXPECT_NE(text.find("5 gates: 1 passed, 2 missed"), std::string::npos) << text;
  // Every line of the table has as many cells: seven, between eight bars that are not escaped.
  std::istringstream lines(text);
  size_t rows = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("|")) continue;
    ++rows;
    size_t bars = 0;
    for (size_t i = 0; i < line.size(); ++i) bars += line[i] == '|' && (i == 0 || line[i - 1] != '\\');
    EXPECT_EQ(bars, 8u) << line;
  }
  EXPECT_EQ(rows, 2u + 5u);
}

}  // namespace
}  // namespace hybray
