#include "harness/table/growing_table.h"

#include "core/base/check.h"
#include "core/base/error.h"
#include "harness/table/csv.h"
#include "harness/table/files.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace hybray {

std::string table_header(std::span<const Column> columns) {
  std::vector<std::string> names{"id"};
  for (const Column& column : columns) names.push_back(column.name);
  return csv_line(names);
}

std::string table_line(std::span<const Column> columns, const std::string& id, const Row& row) {
  size_t known = 0;
  std::vector<std::string> cells{id};
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
  return csv_line(cells);
}

size_t estimated_table_bytes(std::span<const Column> columns, size_t rows) {
  constexpr size_t kCell = 20;  // a double as text, and its comma
  return table_header(columns).size() + rows * (columns.size() + 1) * kCell;
}

GrowingTable::GrowingTable(const std::filesystem::path& folder, const std::string& name, std::string header,
                           TableLines kept)
    : table_(folder / (name + ".csv")),
      partial_(folder / (name + ".csv.partial")),
      header_(std::move(header)),
      lines_(std::move(kept)) {
  std::string start = header_;
  for (const auto& [id, line] : lines_) start += line;
  replace_file(partial_, start);
  descriptor_.number = open(partial_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor_.number < 0)
    throw RuntimeError(partial_.string() + ": cannot be written: " + strerror(errno));
}

GrowingTable::Descriptor::~Descriptor() {
  if (number >= 0) close(number);
}

void GrowingTable::append(const std::string& id, std::string line) {
  const off_t before = lseek(descriptor_.number, 0, SEEK_END);
  ssize_t written = write(descriptor_.number, line.data(), line.size());
  // A disk that fills up takes a part; only the next write says why.
  if (written >= 0 && static_cast<size_t>(written) < line.size()) {
    const size_t begun = static_cast<size_t>(written);
    const ssize_t rest = write(descriptor_.number, line.data() + begun, line.size() - begun);
    written = rest < 0 ? rest : written + rest;
  }
  if (written != static_cast<ssize_t>(line.size())) {
    const std::string reason = written < 0 ? strerror(errno) : "the disk is full";
    if (ftruncate(descriptor_.number, before) != 0) {
      // The torn line has no line end, and whoever resumes drops it.
    }
    throw RuntimeError(fmt::format("{}: cannot be written: {}; its {} rows are kept", partial_.string(),
                                   reason, lines_.size()));
  }
  lines_[id] = std::move(line);
  sync_sometimes();
}

// On every row would cost short points more than they take themselves.
void GrowingTable::sync_sometimes() {
  const auto now = std::chrono::steady_clock::now();
  if (now - synced_ < std::chrono::seconds(1)) return;
  if (fdatasync(descriptor_.number) != 0)
    throw RuntimeError(partial_.string() + ": cannot be written: " + strerror(errno));
  synced_ = now;
}

std::string GrowingTable::content(std::span<const std::string> ids) const {
  std::string content = header_;
  for (const std::string& id : ids) {
    if (const auto line = lines_.find(id); line != lines_.end()) content += line->second;
  }
  return content;
}

void GrowingTable::remove_partial() {
  std::error_code ignored;
  std::filesystem::remove(partial_, ignored);
}

}  // namespace hybray
