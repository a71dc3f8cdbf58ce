// One gate held against one table.
#pragma once

#include "harness/gate/gated_table.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hybray {

// The accepted table of a run, if there is one.
struct Baseline {
  std::filesystem::path file;
  std::optional<GatedTable> table;
};

enum class GateStatus { passed, missed, expected_failure, unexpected_pass };

struct GateResult {
  std::string name, words, reason, expected_failure;
  GateStatus status = GateStatus::passed;
  size_t rows = 0;                  // that the gate looked at
  std::string value;                // the one nearest to its bound, or furthest beyond it
  std::string limit;                // that bound
  std::string margin;               // between the two, in the column's unit; negative: missed by that much
  std::string row;                  // where
  std::vector<std::string> misses;  // every miss, with its row
};

// A gate passes if it has a row and every row keeps to every bound. A missing row, an empty cell, a cell that
// is no finite number and a missing baseline are misses that no expected failure excuses. Throws InputError
// where the table lacks a column of the gate.
GateResult evaluate(const Gate& gate, const GatedTable& table, const Baseline& baseline);

}  // namespace hybray
