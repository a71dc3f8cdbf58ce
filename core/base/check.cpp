#include "core/base/check.h"

namespace hybray::detail {

void check_failed(const char* file, int line, const char* expression, const std::string& operands) {
  std::fprintf(stderr, "%s:%d: check failed: %s%s%s%s\n", file, line, expression,
               operands.empty() ? "" : " (", operands.c_str(), operands.empty() ? "" : ")");
  std::abort();
}

}  // namespace hybray::detail
