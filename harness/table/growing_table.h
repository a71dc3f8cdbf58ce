// The table of a run while it grows: NAME.csv.partial gets one row after the other, each by a single write,
// and becomes NAME.csv at the end. A NAME.csv of an earlier run stays untouched until then; after an
// interrupted run NAME.csv.partial is kept.
#pragma once

#include "harness/experiments/experiment.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace hybray {

// Cells of one row in the order of `columns`, as text. A name in `row` that is no column is a programming
// error; throws RuntimeError, naming the column, for a number that is not finite.
std::vector<std::string> row_cells(std::span<const Column> columns, const Row& row);

class GrowingTable {
 public:
  // Opens FOLDER/NAME.csv.partial and writes the header: `id`, then the columns. Throws InputError where the
  // file cannot be made or another run is writing to it.
  GrowingTable(const std::filesystem::path& folder, const std::string& name, std::span<const Column> columns);
  GrowingTable(const GrowingTable&) = delete;
  GrowingTable& operator=(const GrowingTable&) = delete;

  // Appends the row of point `id`. Throws what row_cells throws, and RuntimeError when the disk is full; the
  // table then stays as it was.
  void append(const std::string& id, const Row& row);

  const std::filesystem::path& file() const { return table_; }
  const std::filesystem::path& partial_file() const { return partial_; }

  // Writes the rows in the order of `ids` to NAME.csv by write-and-rename and removes NAME.csv.partial.
  // Points without a row are left out.
  void finish(std::span<const std::string> ids);

 private:
  struct Descriptor {
    int number = -1;
    ~Descriptor();
  };

  void write_line(const std::string& line);

  std::filesystem::path table_, partial_;
  std::vector<Column> columns_;
  std::string header_;
  std::map<std::string, std::string> lines_;  // by id
  Descriptor descriptor_;                     // of the partial file, locked
};

}  // namespace hybray
