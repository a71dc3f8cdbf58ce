// A table as gates see it: the columns of its experiment, rows by what identifies them, cells as numbers.
#pragma once

#include "harness/gate/gate.h"
#include "harness/table/csv.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hybray {

// A finite decimal number that is all of the text.
std::optional<double> finite_number(const std::string& text);

class GatedTable {
 public:
  // What a run wrote. Throws InputError with file and line: a column twice, no ids, a row with the id of
  // another or with the same keys.
  static GatedTable of_run(const std::filesystem::path& file, const Experiment& experiment);
  // What was accepted: the same without ids.
  static GatedTable accepted(const std::filesystem::path& file, const Experiment& experiment);

  const std::string& file() const { return file_; }
  const Experiment& experiment() const { return *experiment_; }
  const std::vector<std::string>& header() const { return csv_.header; }
  size_t row_count() const { return csv_.rows.size(); }

  bool has(const std::string& column) const { return csv_.column(column) >= 0; }
  // Throws InputError where the table lacks the column.
  void require(const std::string& column) const;

  // The cell as it stands; empty where the table lacks the column.
  const std::string& cell(size_t row, const std::string& column) const;
  // "file.csv:12", for messages.
  std::string place(size_t row) const;

  // Numbers of the rows that all filters let through; a column that the table lacks lets all rows through.
  std::vector<size_t> matching(const std::vector<GateFilter>& filters) const;

  // The values of all identifying columns; a text that is equal for rows of one point only.
  const std::string& identity(size_t row) const { return identities_[row]; }
  std::optional<size_t> find(const std::string& identity) const;

  // "scene=atrium camera=nave": the identifying columns in which the rows of this table differ.
  std::string label(size_t row) const;

 private:
  GatedTable(const std::filesystem::path& file, const Experiment& experiment);
  void refuse_repeated_ids() const;
  void index_rows();

  std::string file_;
  const Experiment* experiment_;
  CsvTable csv_;
  std::vector<std::string> identities_;  // by row
  std::map<std::string, size_t> by_identity_;
  std::vector<std::string> varying_;  // names of identifying columns
};

}  // namespace hybray
