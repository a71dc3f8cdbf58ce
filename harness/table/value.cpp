#include "harness/table/value.h"

#include "core/base/check.h"

#include <cmath>

#include <fmt/format.h>

namespace hybray {

std::string to_text(const Value& value) {
  if (const auto* b = std::get_if<bool>(&value)) return *b ? "true" : "false";
  if (const auto* i = std::get_if<int64_t>(&value)) return fmt::format("{}", *i);
  if (const auto* d = std::get_if<double>(&value)) {
    HYBRAY_CHECK(std::isfinite(*d));
    return fmt::format("{}", *d);
  }
  if (const auto* s = std::get_if<std::string>(&value)) return *s;
  return {};
}

}  // namespace hybray
