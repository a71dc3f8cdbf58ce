// Closing the gaps in a list of rays of which some places were not filled.
#pragma once

#include "core/base/ray_stream.h"

#include <vector>

namespace hybray {

constexpr uint32_t kNoRay = 0xffffffffu;  // RayStream::pixel of a place without a ray

// Removes the places marked kNoRay, in `rays` and in the lists beside it (each of the same size, or empty);
// the order stays. Returns how many they were.
template <class... T>
size_t remove_gaps(RayStream& rays, std::vector<T>&... beside) {
  const size_t n = rays.size();
  size_t out = 0;
  for (size_t i = 0; i < n; ++i) {
    if (rays.pixel[i] == kNoRay) continue;
    if (out != i) {
      rays.set(out, rays.origin(i), rays.direction(i), rays.pixel[i]);
      ((beside.empty() ? void() : void(beside[out] = beside[i])), ...);
    }
    ++out;
  }
  rays.resize(out);
  ((beside.empty() ? void() : beside.resize(out)), ...);
  return n - out;
}

}  // namespace hybray
