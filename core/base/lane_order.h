// For each set of eight lanes, the order that brings its members to the front: the number of the lane that
// goes to place i in bits 4 i to 4 i + 2.
#pragma once

#include <array>
#include <cstdint>

namespace hybray {

inline constexpr std::array<uint32_t, 256> kLaneOrder = [] {
  std::array<uint32_t, 256> orders{};
  for (uint32_t set = 0; set < 256; ++set) {
    uint32_t place = 0;
    for (uint32_t lane = 0; lane < 8; ++lane)
      if (set >> lane & 1) orders[set] |= lane << (4 * place++);
  }
  return orders;
}();

}  // namespace hybray
