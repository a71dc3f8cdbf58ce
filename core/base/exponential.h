// exp(x) for x <= 0 in single precision, from single products and sums in a fixed order: unlike the
// library's, the same bits on every machine, and in lanes (exponential-inl.h). Within 2 units in the last
// place; 0 below -87.
#pragma once

#include <bit>
#include <cstdint>

namespace hybray {

namespace exponential {
inline constexpr float kSmallest = -87.0f;
inline constexpr float kLog2E = 1.44269504f;
// Adding it leaves a number rounded to a whole one in the low bits.
inline constexpr float kWhole = 0x1.8p23f;
// ln 2 in two parts; a product of the first with a whole number below 2^8 is exact.
inline constexpr float kLn2High = 0x1.62e4p-1f, kLn2Low = 0x1.7f7d1cp-20f;
// 1 / k!: the remainder after k = 7 is below 6e-9 for |r| <= ln 2 / 2.
inline constexpr float kTaylor[] = {1.0f,         1.0f,          0.5f,          1.0f / 6.0f,
                                    1.0f / 24.0f, 1.0f / 120.0f, 1.0f / 720.0f, 1.0f / 5040.0f};
}  // namespace exponential

inline float exp_of_negative(float x) {
  using namespace exponential;
  if (!(x >= kSmallest)) return 0.0f;
  const float whole = x * kLog2E + kWhole, n = whole - kWhole;
  const float r = (x - n * kLn2High) - n * kLn2Low;
  // Estrin's scheme: short chains of dependent operations.
  const auto pair = [&](int k) { return kTaylor[k] + kTaylor[k + 1] * r; };
  const float r2 = r * r;
  const float sum = (pair(0) + pair(2) * r2) + (pair(4) + pair(6) * r2) * (r2 * r2);
  return std::bit_cast<float>(std::bit_cast<uint32_t>(sum) + (std::bit_cast<uint32_t>(whole) << 23));
}

}  // namespace hybray
