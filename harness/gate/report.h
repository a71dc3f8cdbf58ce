// What a check found: for people, for continuous integration, and for a page.
#pragma once

#include "harness/gate/evaluate.h"

#include <span>
#include <string>
#include <vector>

namespace hybray {

// The gates of one table.
struct TableReport {
  std::string name;  // of the table, without folder and ending
  std::string file;
  std::string gates;  // where they stand
  size_t rows = 0;
  std::vector<GateResult> results;
};

size_t count_of(std::span<const TableReport> reports, GateStatus status);

// "5 gates: 3 passed, 1 missed, 1 expected failure".
std::string summary(std::span<const TableReport> reports);

// Aligned columns, then every miss on a line of its own.
std::string text_report(std::span<const TableReport> reports);

// JUnit XML, as Jenkins and GitLab read it: a suite for each table, a case for each gate. An expected failure
// is skipped. Characters that XML cannot hold become U+FFFD.
std::string junit_report(std::span<const TableReport> reports);

// GitHub's Markdown.
std::string markdown_report(std::span<const TableReport> reports);

// "passed", "MISSED", "expected failure", "unexpected pass".
const char* label(GateStatus status);

}  // namespace hybray
