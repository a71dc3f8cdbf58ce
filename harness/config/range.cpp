#include "harness/config/range.h"

#include "harness/config/json_value.h"
#include "harness/config/parameter_rules.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> kMembers = {"from", "to", "count", "step", "scale"};
const std::vector<std::string> kScales = {"linear", "log"};
constexpr int kDigits = 12;

double rounded(double x, int decimals) {
  return std::strtod(fmt::format("{:.{}f}", x, decimals).c_str(), nullptr) + 0.0;  // and no -0
}

// Digits after the point that leave kDigits significant ones in a number of this size; more than a double has
// are of no use.
int decimals_for(double size) {
  return std::clamp(kDigits - 1 - static_cast<int>(std::floor(std::log10(std::abs(size)))), 0, 300);
}

double as_number(const Value& value) {
  if (const auto* integer = std::get_if<int64_t>(&value)) return static_cast<double>(*integer);
  return std::get<double>(value);
}

// Reads one range; a class only to share what all steps look at.
class Range {
 public:
  Range(const Parameter& parameter, const Json& json, std::vector<RangeProblem>& problems)
      : parameter_(parameter), json_(json), problems_(problems) {}

  std::vector<Value> values() {
    const size_t before = problems_.size();
    check_keys();
    const Value from = end("from"), to = end("to");
    check_scale();
    if (problems_.size() > before) return {};
    from_ = as_number(from), to_ = as_number(to);
    if (from_ == to_) return fail("to", "found the same value as \"from\"; expected another one");
    if (log_ && !(std::min(from_, to_) > 0)) {
      const char* member = from_ > 0 ? "to" : "from";
      return fail(member, fmt::format("found {}; a log scale needs ends above 0", found_text(json_[member])));
    }
    const std::optional<int64_t> intervals = json_.contains("count") ? from_count() : from_step();
    if (!intervals) return {};
    std::vector<Value> values{from};
    for (int64_t i = 1; i < *intervals; ++i) {
      const double x = between(i, *intervals);
      if (x == as_number(values.back()) || x == to_)
        return fail("", "the values of this range lie so close that they come out equal");
      if (parameter_.type == ParameterType::number) {
        values.emplace_back(x);
      } else if (x == std::floor(x)) {
        values.emplace_back(static_cast<int64_t>(x));
      } else {
        return fail("", fmt::format("value {} of this range is {}; expected {}; a list can give any integers",
                                    i + 1, x, expectation(parameter_)));
      }
    }
    values.push_back(to);
    return values;
  }

 private:
  std::vector<Value> fail(const std::string& member, const std::string& message) {
    problems_.push_back({member, message});
    return {};
  }

  void check_keys() {
    for (const auto& [key, value] : json_.items()) {
      if (std::find(kMembers.begin(), kMembers.end(), key) == kMembers.end())
        problems_.push_back({key, unknown_name("key", key, kMembers), true});
    }
    const int spacings = static_cast<int>(json_.contains("count")) + static_cast<int>(json_.contains("step"));
    if (spacings == 0) fail("", "a range needs \"count\" or \"step\"");
    if (spacings == 2) problems_.push_back({"step", "a range has \"count\" or \"step\", not both", true});
  }

  Value end(const char* member) {
    if (!json_.contains(member)) {
      fail("", fmt::format("a range needs \"{}\"", member));
      return {};
    }
    Value value = scalar_value(json_[member]);
    if (!accept(parameter_, value)) fail(member, rejection(parameter_, found_text(json_[member]), value));
    return value;
  }

  void check_scale() {
    if (!json_.contains("scale")) return;
    const Parameter scale{"scale", ParameterType::choice, "", {}, {}, {}, kScales, ""};
    Value value = scalar_value(json_["scale"]);
    if (!accept(scale, value)) fail("scale", rejection(scale, found_text(json_["scale"]), value));
    log_ = value == Value("log");
  }

  // The number of steps from one end to the other.
  std::optional<int64_t> from_count() {
    const Parameter count{"count", ParameterType::integer, "", {}, 2.0, kMostRangeValues, {}, ""};
    Value value = scalar_value(json_["count"]);
    if (accept(count, value)) return std::get<int64_t>(value) - 1;
    fail("count", rejection(count, found_text(json_["count"]), value));
    return std::nullopt;
  }

  std::optional<int64_t> from_step() {
    const Json& step_json = json_["step"];
    const std::string found = "found " + found_text(step_json);
    const double step = step_json.is_number() ? step_json.get<double>() : std::nan("");
    const double steps = log_ ? std::log(to_ / from_) / std::log(step) : (to_ - from_) / step;
    if (!(log_ ? step > 0 && step != 1 : step != 0) || !(steps > 0)) {
      fail("step", fmt::format("{}; expected a number that, {} again and again, leads from {} to {}", found,
                               log_ ? "multiplied" : "added", from_, to_));
      return std::nullopt;
    }
    if (steps > static_cast<double>(kMostRangeValues - 1)) {
      fail("step", fmt::format("{}, which makes more than {} values", found, kMostRangeValues));
      return std::nullopt;
    }
    const double whole = std::round(steps);
    if (whole < 1 || std::abs(steps - whole) > 1e-9 * steps) {
      fail("step", fmt::format("{}, which leads from {} past {}, not to it", found, from_, to_));
      return std::nullopt;
    }
    return static_cast<int64_t>(whole);
  }

  double between(int64_t i, int64_t intervals) const {
    const double t = static_cast<double>(i) / static_cast<double>(intervals);
    if (log_) {
      const double x = from_ * std::exp(t * std::log(to_ / from_));
      return rounded(x, decimals_for(x));
    }
    return rounded(from_ + (to_ - from_) * t, decimals_for(std::max(std::abs(from_), std::abs(to_))));
  }

  const Parameter& parameter_;
  const Json& json_;
  std::vector<RangeProblem>& problems_;
  double from_ = 0, to_ = 0;
  bool log_ = false;
};

}  // namespace

bool takes_range(const Parameter& parameter) {
  return parameter.type == ParameterType::integer || parameter.type == ParameterType::number;
}

std::vector<Value> range_values(const Parameter& parameter, const Json& range,
                                std::vector<RangeProblem>& problems) {
  return Range(parameter, range, problems).values();
}

}  // namespace hybray
