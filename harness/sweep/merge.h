// One table of the tables of shards.
#pragma once

#include "harness/experiments/experiment.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hybray {

struct MergeResult {
  std::filesystem::path table;
  size_t points = 0, missing = 0;     // of the whole sweep; of those, without a row
  std::vector<std::string> warnings;  // for people: rows of different machines stand beside one another
};

// Writes the rows of all `folders`, in frozen order, to one table in `output`, with a manifest.json that
// holds those of the shards, and their pictures. The metric and count columns are then those of a single run,
// byte for byte. Of a point with a row in several folders the first one's stands.
//
// Throws InputError: a folder without a complete table and manifest, or with a table that its manifest does
// not describe; folders whose config, points, program or choice of timing differ; a point whose metrics or
// counts differ between two folders; a point without a row, unless `allow_missing`; an output folder that is
// one of them, cannot be written to or is in use. Nothing is then written.
MergeResult merge_tables(std::span<const Experiment> experiments,
                         std::span<const std::filesystem::path> folders, const std::filesystem::path& output,
                         bool allow_missing);

}  // namespace hybray
