// How a screen-space ray ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace hybray::ssrm {

// HIT, MISS, or UNKNOWN with the first event that ended the march, or the check that undid its HIT.
enum class Verdict : uint8_t {
  hit,   // passed the slanted-plane test of the accepted pixel
  miss,  // in front of all stored depth, at pixel centres, until it left the scene's bounds inside the view
  offscreen,   // left the view volume through the side of the screen or the far plane
  viewer,      // left it through the near plane
  behind,      // already behind the failing pixel's slanted plane where it enters that pixel
  correction,  // any other failed correction
  budget,      // step budget exhausted
  rejected,    // a HIT that failed a check after the march (hit_checks.h)
};
constexpr int kVerdicts = 8;
const char* label(Verdict verdict);

constexpr bool is_unknown(Verdict v) {
  return v > Verdict::miss;
}

constexpr float kNoDistance = std::numeric_limits<float>::infinity();
constexpr uint32_t kNoPixel = 0xffffffffu;  // the paper's (-1, -1)

// One result for each ray, in the order of the rays.
struct MarchResults {
  std::vector<Verdict> verdict;
  std::vector<uint32_t> pixel;  // row-major index of the accepted pixel of a HIT, or of that which stopped a
                                // ray without a closer look (MarchOptions::correct), else kNoPixel
  std::vector<float> distance;  // metres, where a HIT lies by who found or checked it; not finite, or the
                                // list empty: where the ray meets the accepted pixel's plane
  uint64_t steps = 0;           // depth samples read, all rays together
  // L up to which each ray is in front of the stored depth: where it ended, or where it enters the pixel at
  // which it stopped. Its own pixel is not looked at. Written only where ask_proved() made room for it.
  std::vector<float> proved;

  void resize(size_t n) {
    verdict.resize(n);
    pixel.resize(n);
  }
  void ask_proved() { proved.resize(size()); }
  size_t size() const { return verdict.size(); }
};

}  // namespace hybray::ssrm
