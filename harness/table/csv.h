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

  // Number of the column of that name, or -1.
  int column(std::string_view name) const;
};

// Reads a whole table. `name` stands in messages. Throws InputError with line and column for an open quote,
// text after a closing quote, a row whose length differs from the header's, or no header at all.
CsvTable parse_csv(std::string_view text, const std::string& name);

// The same from a file; throws InputError where it cannot be read.
CsvTable read_csv(const std::filesystem::path& file);

}  // namespace hybray
