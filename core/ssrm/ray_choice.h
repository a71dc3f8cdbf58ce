// Which rays of a stream are marched: all, listed ones, or runs of consecutive ones. A run of mirror rays is
// a tile of 8x8 pixels where all are covered, and loads as it lies in memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hybray::ssrm {

inline constexpr size_t kRun = 64;  // consecutive rays; the stream's last run may be shorter
constexpr size_t runs_of(size_t rays) {
  return (rays + kRun - 1) / kRun;
}

// The one ray of each run that is marched first, to learn what its run is worth (predictor.h): next to the
// middle of its tile.
inline constexpr size_t kSampleOfRun = 15;
constexpr size_t sampled_ray(size_t run, size_t rays) {
  return std::min(kRun * run + kSampleOfRun, rays - 1);
}

struct RayChoice {
  enum class Of : uint8_t {
    all,
    listed,
    runs,          // all rays of listed runs,
    rest_of_runs,  // all but the sampled ones
  };
  Of of = Of::all;
  std::span<const uint32_t> which{};  // numbers of rays, or of runs

  bool by_runs() const { return of >= Of::runs; }
  // What is counted and divided among threads: rays, or runs.
  size_t parts(size_t rays) const { return of == Of::all ? rays : which.size(); }
  size_t rays_a_part() const { return by_runs() ? kRun : 1; }

  // Calls visit(ray) for the rays of parts [begin, end), in order.
  template <class Visit>
  void visit(size_t begin, size_t end, size_t rays, const Visit& visit) const {
    for (size_t k = begin; k < end; ++k) {
      if (!by_runs()) {
        visit(of == Of::all ? k : which[k]);
        continue;
      }
      const size_t first = kRun * which[k], sampled = sampled_ray(which[k], rays);
      for (size_t i = first; i < std::min(first + kRun, rays); ++i)
        if (of == Of::runs || i != sampled) visit(i);
    }
  }
};

}  // namespace hybray::ssrm
