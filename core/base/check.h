// Checks of programming errors. They stay on in release builds, cost one comparison, and print both operands.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

namespace hybray::detail {

[[noreturn]] void check_failed(const char* file, int line, const char* expression,
                               const std::string& operands);

template <class A, class B>
[[noreturn]] void check_failed(const char* file, int line, const char* expression, const A& a, const B& b) {
  std::ostringstream text;
  text << a << " vs " << b;
  check_failed(file, line, expression, text.str());
}

}  // namespace hybray::detail

#define HYBRAY_CHECK(condition) \
  ((condition) ? void(0) : ::hybray::detail::check_failed(__FILE__, __LINE__, #condition, std::string()))
#define HYBRAY_CHECK_OP(a, op, b) \
  (((a)op(b)) ? void(0) : ::hybray::detail::check_failed(__FILE__, __LINE__, #a " " #op " " #b, (a), (b)))
#define HYBRAY_CHECK_EQ(a, b) HYBRAY_CHECK_OP(a, ==, b)
#define HYBRAY_CHECK_LE(a, b) HYBRAY_CHECK_OP(a, <=, b)
#define HYBRAY_CHECK_LT(a, b) HYBRAY_CHECK_OP(a, <, b)
