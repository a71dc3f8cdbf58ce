// What earlier sessions left in a folder that a run can take over.
#pragma once

#include "harness/sweep/manifest.h"
#include "harness/table/growing_table.h"

#include <filesystem>
#include <string>
#include <vector>

namespace hybray {

// Of NAME.csv.partial: it has no row, its rows are taken over, or they cannot be.
enum class PartialRows { none, taken_over, foreign };

struct EarlierRows {
  TableLines lines;               // by id, of this run's points and of others
  std::vector<Session> sessions;  // that made them, by start
  bool fresh = false;             // they are of an interrupted run that had been told to start over
  PartialRows partial = PartialRows::none;
  std::vector<std::string> remarks;  // what was found and is not taken over, and why; each a sentence
};

// Looks into FOLDER/NAME.csv.partial, which the manifest.json.partial beside it must describe, and into
// FOLDER/NAME.csv, whose manifest.json must hold its content's hash. Their rows are taken over where the
// header is `header` and the origin `origin`. A torn last row is left out. Throws nothing for damaged files:
// what cannot be read is not taken over.
EarlierRows find_earlier_rows(const std::filesystem::path& folder, const std::string& name,
                              const std::string& header, const RowOrigin& origin);

}  // namespace hybray
