#include "harness/table/growing_table.h"

#include "core/base/check.h"
#include "core/base/error.h"
#include "harness/table/csv.h"
#include "harness/table/files.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace hybray {

std::vector<std::string> row_cells(std::span<const Column> columns, const Row& row) {
  size_t known = 0;
  std::vector<std::string> cells;
  for (const Column& column : columns) {
    const auto cell = row.find(column.name);
    if (cell == row.end()) {
      cells.emplace_back();
      continue;
    }
    ++known;
    const auto* number = std::get_if<double>(&cell->second);
    if (number && !std::isfinite(*number)) {
      throw RuntimeError("column \"" + column.name + "\" came out as a number that is not finite");
    }
    cells.push_back(to_text(cell->second));
  }
  HYBRAY_CHECK_EQ(known, row.size());  // every cell has a column
  return cells;
}

GrowingTable::GrowingTable(const std::filesystem::path& folder, const std::string& name,
                           std::span<const Column> columns)
    : table_(folder / (name + ".csv")),
      partial_(folder / (name + ".csv.partial")),
      columns_(columns.begin(), columns.end()) {
  std::vector<std::string> names{"id"};
  for (const Column& column : columns) names.push_back(column.name);
  header_ = csv_line(names);

  descriptor_.number = open(partial_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_.number < 0)
    throw InputError(partial_.string(), std::string("cannot be written: ") + strerror(errno));
  if (flock(descriptor_.number, LOCK_EX | LOCK_NB) != 0 || ftruncate(descriptor_.number, 0) != 0) {
    const bool locked = errno == EWOULDBLOCK;
    const std::string reason = locked ? "another run is writing to it" : strerror(errno);
    throw InputError(partial_.string(), "cannot be written: " + reason);
  }
  write_line(header_);
}

GrowingTable::Descriptor::~Descriptor() {
  if (number >= 0) close(number);
}

void GrowingTable::append(const std::string& id, const Row& row) {
  std::vector<std::string> cells = row_cells(columns_, row);
  cells.insert(cells.begin(), id);
  std::string line = csv_line(cells);
  write_line(line);
  lines_[id] = std::move(line);
}

void GrowingTable::finish(std::span<const std::string> ids) {
  std::string content = header_;
  for (const std::string& id : ids) {
    if (const auto line = lines_.find(id); line != lines_.end()) content += line->second;
  }
  replace_file(table_, content);
  std::error_code ignored;  // the table is complete; a leftover partial file does no harm
  std::filesystem::remove(partial_, ignored);
}

void GrowingTable::write_line(const std::string& line) {
  const off_t before = lseek(descriptor_.number, 0, SEEK_END);
  const ssize_t written = write(descriptor_.number, line.data(), line.size());
  if (written == static_cast<ssize_t>(line.size())) return;
  const std::string reason = written < 0 ? strerror(errno) : "the disk is full";
  if (ftruncate(descriptor_.number, before) !=
      0) { /* what follows the last line end is torn, and readers say so */
  }
  throw RuntimeError(partial_.string() + ": cannot be written: " + reason);
}

}  // namespace hybray
