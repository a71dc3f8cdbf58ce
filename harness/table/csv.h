// Comma-separated values as RFC 4180 describes them, with a header line. Lines end in LF when written, in LF
// or CRLF when read.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hybray {

// One line with its line end. Cells that hold a comma, a quote or a line end are quoted.
std::string csv_line(std::span<const std::string> cells);

struct CsvTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  // each as long as the header
  std::vector<int> lines;                      // where each row begins, from 1; the header is in line 1

  // Number of the column of that name, or -1.
  int column(std::string_view name) const;
};

// Reads a whole table. `name` stands in messages. Throws InputError with line and column for an open quote,
// text after a closing quote, a row whose length differs from the header's, or no header at all.
CsvTable parse_csv(std::string_view text, const std::string& name);

// The rows that stand whole at the beginning of `text`, which a crash may have torn: up to the first that has
// no line end, an open quote or another number of cells than the header. Never throws; without a whole header
// there is none, and no row.
CsvTable parse_whole_rows(std::string_view text);

// Reads a whole table from a file; throws as parse_csv does, and InputError where the file cannot be read.
CsvTable read_csv(const std::filesystem::path& file);

}  // namespace hybray
