// A function of bounded slope along a line: its first zero by subdivision that leaves out only intervals in
// which the bound rules a zero out.
#pragma once

#include <cmath>
#include <optional>

namespace hybray::test {

// The least t in [a, b] from which on f has another sign than at the first point, to `accuracy`; f changes by
// at most `slope` x the way. Both sides of a zero are told apart only where they are further than `accuracy`
// apart.
template <class Function>
std::optional<double> first_sign_change(const Function& f, double a, double b, double slope, double accuracy,
                                        bool negative) {
  const double middle = 0.5 * (a + b), value = f(middle);
  if (std::abs(value) > 0.5 * slope * (b - a))
    return (value < 0.0) != negative ? std::optional(a) : std::nullopt;
  if (b - a < accuracy) return (f(b) < 0.0) != negative ? std::optional(middle) : std::nullopt;
  if (const auto t = first_sign_change(f, a, middle, slope, accuracy, negative)) return t;
  return first_sign_change(f, middle, b, slope, accuracy, negative);
}

}  // namespace hybray::test
