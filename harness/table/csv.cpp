#include "harness/table/csv.h"

#include "core/base/error.h"
#include "harness/table/files.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace hybray {
namespace {

// Walks over the text one cell at a time and knows where it is.
class CsvScanner {
 public:
  CsvScanner(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  bool at_end() const { return next_ == text_.size(); }
  int line() const { return line_; }
  bool at_line_start() const { return next_ > 0 && text_[next_ - 1] == '\n'; }

  std::vector<std::string> row() {
    std::vector<std::string> cells;
    do {
      cells.push_back(cell());
    } while (take(','));
    take('\r');
    if (!at_end() && !take('\n')) fail("expected a comma or the end of the line here");
    return cells;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}:{}:{}", name_, line_, next_ - line_start_ + 1), message);
  }

  bool take(char c) {
    if (at_end() || text_[next_] != c) return false;
    ++next_;
    if (c == '\n') {
      ++line_;
      line_start_ = next_;
    }
    return true;
  }

  std::string cell() {
    if (take('"')) return quoted_cell();
    const size_t first = next_;
    next_ = std::min(text_.find_first_of(",\r\n\"", first), text_.size());
    return std::string(text_.substr(first, next_ - first));
  }

  std::string quoted_cell() {
    const int first_line = line_;
    std::string content;
    while (true) {
      if (at_end()) fail(fmt::format("the quote opened in line {} is never closed", first_line));
      const char c = text_[next_];
      take(c);
      if (c == '"' && !take('"')) return content;  // a doubled quote stands for one
      content += c;
    }
  }

  std::string_view text_;
  const std::string& name_;
  size_t next_ = 0, line_start_ = 0;
  int line_ = 1;
};

}  // namespace

std::string csv_line(std::span<const std::string> cells) {
  std::string line;
  for (size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    if (cells[i].find_first_of(",\"\r\n") == std::string::npos) {
      line += cells[i];
      continue;
    }
    line += '"';
    for (const char c : cells[i]) {
      if (c == '"') line += '"';
      line += c;
    }
    line += '"';
  }
  return line + '\n';
}

int CsvTable::column(std::string_view name) const {
  const auto found = std::find(header.begin(), header.end(), name);
  return found == header.end() ? -1 : static_cast<int>(found - header.begin());
}

CsvTable parse_csv(std::string_view text, const std::string& name) {
  CsvScanner scanner(text, name);
  if (scanner.at_end()) throw InputError(name, "the table is empty: not even a header is there");
  CsvTable table;
  table.header = scanner.row();
  while (!scanner.at_end()) {
    const int line = scanner.line();
    table.rows.push_back(scanner.row());
    table.lines.push_back(line);
    if (table.rows.back().size() != table.header.size()) {
      throw InputError(fmt::format("{}:{}", name, line),
                       fmt::format("found {} cells; expected {}, as in the header", table.rows.back().size(),
                                   table.header.size()));
    }
  }
  return table;
}

CsvTable parse_whole_rows(std::string_view text) {
  const std::string name;
  CsvScanner scanner(text, name);
  CsvTable table;
  try {
    while (!scanner.at_end()) {
      std::vector<std::string> row = scanner.row();
      if (!scanner.at_line_start()) break;
      if (table.header.empty()) {
        table.header = std::move(row);
      } else if (row.size() == table.header.size()) {
        table.rows.push_back(std::move(row));
      } else {
        break;
      }
    }
  } catch (const InputError&) {  // the text ends, or goes wrong, inside this row
  }
  return table;
}

CsvTable read_csv(const std::filesystem::path& file) {
  return parse_csv(read_file(file), file.string());
}

}  // namespace hybray
