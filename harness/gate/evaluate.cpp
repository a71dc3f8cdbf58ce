#include "harness/gate/evaluate.h"

#include "harness/gate/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace hybray {
namespace {

// One side that a value must keep to.
struct Limit {
  double value;
  bool least;          // else greatest
  std::string source;  // what it follows from
};

std::vector<Limit> baseline_limits(const BaselineBound& bound, const std::string& cell, double accepted) {
  const double allowed = bound.relative ? bound.allowed * std::abs(accepted) : bound.allowed;
  const std::string source = ", accepted " + cell;
  const bool least = bound.rule == BaselineRule::near || bound.better == Better::higher;
  const bool greatest = bound.rule == BaselineRule::near || bound.better == Better::lower;
  std::vector<Limit> limits;
  if (least) limits.push_back({accepted - allowed, true, source});
  if (greatest) limits.push_back({accepted + allowed, false, source});
  return limits;
}

// Holds the cells of one gate's column against its bounds.
class Evaluation {
 public:
  Evaluation(const Gate& gate, const GatedTable& table, const Baseline& baseline)
      : gate_(gate), table_(table), baseline_(baseline) {
    result_.name = gate.name;
    result_.words = gate_words(gate);
    result_.reason = gate.reason;
    result_.expected_failure = gate.expected_failure;
  }

  GateResult run() {
    if (gate_.column) table_.require(gate_.column->name);
    for (const GateFilter& filter : gate_.where) table_.require(filter.column->name);
    const std::vector<size_t> rows = table_.matching(gate_.where);
    result_.rows = rows.size();
    if (rows.empty()) absent("no row matches");
    if (gate_.baseline && !baseline_.table)
      absent(baseline_.file.string() + " is not there: nothing was accepted yet");
    if (gate_.column) {
      for (const size_t row : rows) cell(row);
    }
    if (gate_.baseline && gate_.baseline->rule == BaselineRule::unchanged && baseline_.table) unchanged();
    result_.status = status();
    return std::move(result_);
  }

 private:
  GateStatus status() const {
    if (absent_ || (!result_.misses.empty() && gate_.expected_failure.empty())) return GateStatus::missed;
    if (!result_.misses.empty()) return GateStatus::expected_failure;
    return gate_.expected_failure.empty() ? GateStatus::passed : GateStatus::unexpected_pass;
  }

  // What should be measured or accepted and is not.
  void absent(const std::string& what) {
    absent_ = true;
    result_.misses.push_back(what);
  }

  void cell(size_t row) {
    const std::string& text = table_.cell(row, gate_.column->name);
    if (text.empty()) return absent(fmt::format("{}: the cell is empty", table_.label(row)));
    if (gate_.column->kind == ColumnKind::key) return;  // compared as text
    const auto value = finite_number(text);
    if (!value) return absent(fmt::format("{}: {} is not a finite number", table_.label(row), text));
    std::vector<Limit> limits;
    if (gate_.min) limits.push_back({*gate_.min, true, ""});
    if (gate_.max) limits.push_back({*gate_.max, false, ""});
    if (gate_.baseline && gate_.baseline->rule != BaselineRule::unchanged && baseline_.table) {
      for (Limit& limit : limits_of_baseline(row)) limits.push_back(std::move(limit));
    }
    for (const Limit& limit : limits) hold(row, text, *value, limit);
  }

  std::vector<Limit> limits_of_baseline(size_t row) {
    const auto counterpart = baseline_.table->find(table_.identity(row));
    if (!counterpart) {
      absent(table_.label(row) + ": the accepted table has no such row");
      return {};
    }
    const std::string& text = baseline_.table->cell(*counterpart, gate_.column->name);
    const auto accepted = finite_number(text);
    if (accepted) return baseline_limits(*gate_.baseline, text, *accepted);
    absent(fmt::format("{}: the accepted value is {}", table_.label(row),
                       text.empty() ? "missing" : text + ", not a finite number"));
    return {};
  }

  void hold(size_t row, const std::string& text, double value, const Limit& limit) {
    const double margin = limit.least ? value - limit.value : limit.value - value;
    if (margin < 0.0) {
      result_.misses.push_back(fmt::format(
          "{}: {} is {} the {} {:.6g} by {:.3g}{}", table_.label(row), text, limit.least ? "below" : "above",
          limit.least ? "least" : "greatest", limit.value, -margin, limit.source));
    }
    if (margin >= tightest_) return;
    tightest_ = margin;
    result_.value = fmt::format("{:.6g}", value);
    result_.limit = fmt::format("{} {:.6g}", limit.least ? ">=" : "<=", limit.value);
    result_.margin = fmt::format("{:.3g}", margin);
    result_.row = table_.label(row);
  }

  void unchanged() {
    std::vector<const Column*> columns{gate_.column};
    if (!gate_.column) columns = compared_columns(table_.experiment());
    Comparisons found = compare(table_, *baseline_.table, columns, gate_.where);
    if (!gate_.column) report_foreign_columns(found);
    for (const std::string& what : found.missing) absent(what);
    if (result_.misses.empty() && found.differences.empty() && gate_.min == std::nullopt &&
        gate_.max == std::nullopt) {
      result_.value = fmt::format("{} of {} cells moved", found.moved, found.cells);
      if (found.moved > 0) result_.margin = fmt::format("{:.0f} % of tolerance", 100.0 * found.least_left);
      result_.row = found.tightest;
    }
    result_.misses.insert(result_.misses.end(), found.differences.begin(), found.differences.end());
  }

  void report_foreign_columns(Comparisons& found) const {
    for (const std::string& name : baseline_.table->header()) {
      const auto is_known = [&](const Column& c) { return c.name == name; };
      const auto& known = table_.experiment().columns;
      if (std::none_of(known.begin(), known.end(), is_known))
        found.missing.push_back(fmt::format("{} is accepted, but the experiment has no such column", name));
    }
  }

  const Gate& gate_;
  const GatedTable& table_;
  const Baseline& baseline_;
  GateResult result_;
  bool absent_ = false;
  double tightest_ = std::numeric_limits<double>::infinity();
};

}  // namespace

GateResult evaluate(const Gate& gate, const GatedTable& table, const Baseline& baseline) {
  return Evaluation(gate, table, baseline).run();
}

}  // namespace hybray
