// exp(x) for x <= 0 from single products and sums in a fixed order: unlike the library's, the same bits on
// every machine, and in lanes (exponential-inl.h). Within 2 units in the last place; 0 below -708.
#pragma once

#include <bit>
#include <cstdint>

namespace hybray {

namespace exponential {
inline constexpr double kSmallest = -708.0;
inline constexpr double kLog2E = 1.4426950408889634;
// Adding it leaves a number rounded to a whole one in the low bits.
inline constexpr double kWhole = 0x1.8p52;
// ln 2 in two parts; a product of the first with a whole number below 2^11 is exact.
inline constexpr double kLn2High = 0x1.62e42fefa0000p-1, kLn2Low = 0x1.cf79abc9e3b3ap-40;
// 1 / k!: the remainder after k = 13 is below 5e-18 for |r| <= ln 2 / 2.
inline constexpr double kTaylor[] = {1.0,
                                     1.0,
                                     0.5,
                                     1.0 / 6.0,
                                     1.0 / 24.0,
                                     1.0 / 120.0,
                                     1.0 / 720.0,
                                     1.0 / 5040.0,
                                     1.0 / 40320.0,
                                     1.0 / 362880.0,
                                     1.0 / 3628800.0,
                                     1.0 / 39916800.0,
                                     1.0 / 479001600.0,
                                     1.0 / 6227020800.0};
}  // namespace exponential

inline double exp_of_negative(double x) {
  using namespace exponential;
  if (!(x >= kSmallest)) return 0.0;
  const double whole = x * kLog2E + kWhole, n = whole - kWhole;
  const double r = (x - n * kLn2High) - n * kLn2Low;
  // Estrin's scheme: short chains of dependent operations.
  const auto pair = [&](int k) { return kTaylor[k] + kTaylor[k + 1] * r; };
  const double r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
  const auto four = [&](int k) { return pair(k) + pair(k + 2) * r2; };
  const double sum = (four(0) + four(4) * r4) + (four(8) + pair(12) * r4) * r8;
  return std::bit_cast<double>(std::bit_cast<uint64_t>(sum) + (std::bit_cast<uint64_t>(whole) << 52));
}

}  // namespace hybray
