#include "harness/gate/gate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hybray {
namespace {

std::string baseline_words(const BaselineBound& bound) {
  if (bound.rule == BaselineRule::unchanged) return "as accepted";
  const std::string amount = bound.relative ? fmt::format("{} of the accepted value", bound.allowed)
                                            : fmt::format("{}", bound.allowed);
  if (bound.rule == BaselineRule::near) return "within " + amount + " of the accepted value";
  return fmt::format("at most {} {} than accepted", amount,
                     bound.better == Better::higher ? "lower" : "higher");
}

std::string filter_words(const GateFilter& filter) {
  std::vector<std::string> values;
  for (const Value& value : filter.values) values.push_back(to_text(value));
  return fmt::format("{} = {}", filter.column->name, fmt::join(values, " | "));
}

}  // namespace

std::string gate_words(const Gate& gate) {
  std::vector<std::string> bounds;
  if (gate.min) bounds.push_back(fmt::format(">= {}", *gate.min));
  if (gate.max) bounds.push_back(fmt::format("<= {}", *gate.max));
  if (gate.baseline) bounds.push_back(baseline_words(*gate.baseline));
  std::string words =
      fmt::format("{} {}", gate.column ? gate.column->name : "every column", fmt::join(bounds, " and "));
  std::vector<std::string> filters;
  for (const GateFilter& filter : gate.where) filters.push_back(filter_words(filter));
  return filters.empty() ? words : fmt::format("{} where {}", words, fmt::join(filters, ", "));
}

Gate as_accepted() {
  Gate gate;
  gate.baseline = BaselineBound{};
  gate.name = gate_words(gate);
  return gate;
}

}  // namespace hybray
