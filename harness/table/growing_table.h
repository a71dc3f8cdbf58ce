// The table of a run while it grows: NAME.csv.partial holds every finished row, NAME.csv the last complete
// table, which stays untouched until the next one is complete.
#pragma once

#include "harness/experiments/experiment.h"

#include <chrono>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace hybray {

// The first line of a table: `id`, then the columns.
std::string table_header(std::span<const Column> columns);

// The line of point `id`. A name in `row` that is no column is a programming error; throws RuntimeError,
// naming the column, for a number that is not finite.
std::string table_line(std::span<const Column> columns, const std::string& id, const Row& row);

// Bytes that a table of so many rows about takes.
size_t estimated_table_bytes(std::span<const Column> columns, size_t rows);

// Lines by the id of their point.
using TableLines = std::map<std::string, std::string>;

class GrowingTable {
 public:
  // Begins FOLDER/NAME.csv.partial with the header and the lines `kept` of earlier sessions, in place of what
  // it held before. Throws RuntimeError where that cannot be written. The caller sees to it that nobody else
  // writes to it (FolderLock).
  GrowingTable(const std::filesystem::path& folder, const std::string& name, std::string header,
               TableLines kept = {});
  GrowingTable(const GrowingTable&) = delete;
  GrowingTable& operator=(const GrowingTable&) = delete;

  // Appends a line by a single write: a kill leaves it whole or not there. At most once a second the lines so
  // far are handed to the disk as well, against a loss of power. Throws RuntimeError when the disk is full;
  // the table then stays as it was.
  void append(const std::string& id, std::string line);

  const TableLines& lines() const { return lines_; }
  const std::filesystem::path& file() const { return table_; }
  const std::filesystem::path& partial_file() const { return partial_; }

  // The lines of `ids` in that order, below the header. Points without a line are left out.
  std::string content(std::span<const std::string> ids) const;

  // Removes NAME.csv.partial; nothing may be appended afterwards.
  void remove_partial();

 private:
  struct Descriptor {
    int number = -1;
    ~Descriptor();
  };

  void sync_sometimes();

  std::filesystem::path table_, partial_;
  std::string header_;
  TableLines lines_;
  Descriptor descriptor_;  // of the partial file
  std::chrono::steady_clock::time_point synced_ = std::chrono::steady_clock::now();
};

}  // namespace hybray
