#include "harness/gate/gated_table.h"

#include "core/base/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include <fmt/format.h>

namespace hybray {
namespace {

bool is_value(const std::string& cell, const Value& value) {
  if (to_text(value) == cell) return true;
  const auto number = finite_number(cell);
  if (const auto* integer = std::get_if<int64_t>(&value))
    return number && *number == static_cast<double>(*integer);
  const auto* real = std::get_if<double>(&value);
  return real && number && *number == *real;
}

}  // namespace

std::optional<double> finite_number(const std::string& text) {
  double number = 0.0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  if (error != std::errc() || end != last || !std::isfinite(number)) return std::nullopt;
  return number;
}

GatedTable GatedTable::of_run(const std::filesystem::path& file, const Experiment& experiment) {
  GatedTable table(file, experiment);
  table.require("id");
  table.refuse_repeated_ids();
  table.index_rows();
  return table;
}

GatedTable GatedTable::accepted(const std::filesystem::path& file, const Experiment& experiment) {
  GatedTable table(file, experiment);
  table.index_rows();
  return table;
}

GatedTable::GatedTable(const std::filesystem::path& file, const Experiment& experiment)
    : file_(file.string()), experiment_(&experiment), csv_(read_csv(file)) {
  std::set<std::string> names;
  for (const std::string& name : csv_.header) {
    if (!names.insert(name).second)
      throw InputError(file_ + ":1", fmt::format("the column \"{}\" stands twice in the header", name));
  }
}

void GatedTable::require(const std::string& column) const {
  if (has(column)) return;
  throw InputError(file_ + ":1",
                   fmt::format("the column \"{}\" is missing: this is no table of the experiment "
                               "\"{}\" of this version of the program",
                               column, experiment_->name));
}

void GatedTable::refuse_repeated_ids() const {
  std::map<std::string, size_t> first;
  for (size_t row = 0; row < row_count(); ++row) {
    const auto [other, fresh] = first.emplace(cell(row, "id"), row);
    if (!fresh) {
      throw InputError(place(row), fmt::format("the id \"{}\" stands twice; its first place is line {}",
                                               cell(row, "id"), csv_.lines[other->second]));
    }
  }
}

void GatedTable::index_rows() {
  std::vector<std::string> keys;
  for (const Column& column : experiment_->columns) {
    if (comparison_of(column) == Comparison::identity) keys.push_back(column.name);
  }
  for (size_t row = 0; row < row_count(); ++row) {
    std::vector<std::string> cells;
    for (const std::string& key : keys) cells.push_back(cell(row, key));
    identities_.push_back(csv_line(cells));
    const auto [other, fresh] = by_identity_.emplace(identities_.back(), row);
    if (!fresh) {
      throw InputError(place(row),
                       fmt::format("all keys are those of line {}: which of the two rows is meant "
                                   "cannot be told",
                                   csv_.lines[other->second]));
    }
  }
  for (const std::string& key : keys) {
    for (size_t row = 1; row < row_count(); ++row) {
      if (cell(row, key) == cell(0, key)) continue;
      varying_.push_back(key);
      break;
    }
  }
}

const std::string& GatedTable::cell(size_t row, const std::string& column) const {
  static const std::string none;
  const int index = csv_.column(column);
  return index < 0 ? none : csv_.rows[row][static_cast<size_t>(index)];
}

std::string GatedTable::place(size_t row) const {
  return fmt::format("{}:{}", file_, csv_.lines[row]);
}

std::vector<size_t> GatedTable::matching(const std::vector<GateFilter>& filters) const {
  std::vector<size_t> rows;
  for (size_t row = 0; row < row_count(); ++row) {
    const bool matches = std::all_of(filters.begin(), filters.end(), [&](const GateFilter& filter) {
      const auto is_wanted = [&](const Value& value) {
        return is_value(cell(row, filter.column->name), value);
      };
      return !has(filter.column->name) || std::any_of(filter.values.begin(), filter.values.end(), is_wanted);
    });
    if (matches) rows.push_back(row);
  }
  return rows;
}

std::optional<size_t> GatedTable::find(const std::string& identity) const {
  const auto found = by_identity_.find(identity);
  if (found == by_identity_.end()) return std::nullopt;
  return found->second;
}

std::string GatedTable::label(size_t row) const {
  std::string label;
  for (const std::string& key : varying_)
    label += fmt::format("{}{}={}", label.empty() ? "" : " ", key, cell(row, key));
  return label.empty() ? fmt::format("line {}", csv_.lines[row]) : label;
}

}  // namespace hybray
