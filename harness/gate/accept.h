// Making a table the accepted one.
#pragma once

#include "harness/gate/evaluate.h"

#include <string>
#include <vector>

namespace hybray {

struct Acceptance {
  std::string csv;  // the accepted table that is to be
  std::vector<std::string>
      changes;       // what is not as it was, each with its row; empty where nothing was accepted yet
  size_t moved = 0;  // cells that changed within their tolerance
};

// What accepting `table` means: its identifying and compared columns, and those that a gate holds against
// accepted values, without columns that are empty in every row. Throws InputError with file and line for a
// table without rows and for a cell that is no finite number where the column holds numbers.
Acceptance prepare_acceptance(const GatedTable& table, const std::vector<Gate>& gates,
                              const Baseline& before);

}  // namespace hybray
