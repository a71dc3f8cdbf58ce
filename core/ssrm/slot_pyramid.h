// Where a ray that has one layer in front of it stays so: for each cell, the farthest that the first layer
// reaches and the nearest that any further one does. A ray between the two in the whole cell crosses nothing
// there, and skips it; a min-max pyramid, of rays that are behind what the viewer sees.
//
// The bounds hold for the slanted planes over the whole area of each pixel, not for its centre alone, so that
// skipping changes no result.
#pragma once

#include "core/gbuffer/depth_layers.h"
#include "core/ssrm/correction.h"

#include <vector>

namespace hybray::ssrm {

// How far apart, in pixels' worth of their slopes, the surface on one side of a ray and the one on its other
// side in the pixel before must be to be told apart (march_layers.h).
inline constexpr double kContinuation = 1.0;

// Which space between two layers a ray may be in without having crossed a surface.
enum class FreeSpace : uint8_t {
  any,         // naive: all
  not_solids,  // all but that between a front face and a back face: the inside of a body
  closed,  // that between a back face and a front face alone, as if all surfaces were those of closed bodies
};
constexpr bool is_free(FreeSpace rule, bool front_faces_viewer, bool back_faces_viewer) {
  if (rule == FreeSpace::any) return true;
  if (rule == FreeSpace::closed) return !front_faces_viewer && back_faces_viewer;
  return !front_faces_viewer || back_faces_viewer;
}

class SlotPyramid {
 public:
  // Of the same view and layers as the marcher's; all threads. Space that is not free is never clear.
  SlotPyramid(const DepthView& first, const DepthLayers& layers, FreeSpace rule);

  int levels() const { return static_cast<int>(levels_.size()) + 1; }  // with level 0, which is not kept
  // Whether a ray whose march depths lie in [nearest, farthest] is between the first layer and all further
  // ones in the whole cell (x, y) of `level` >= 1.
  bool clear(int level, int x, int y, float nearest, float farthest) const {
    const Level& l = levels_[static_cast<size_t>(level) - 1];
    const Bounds& b =
        texels_[l.first + static_cast<size_t>(y) * static_cast<size_t>(l.width) + static_cast<size_t>(x)];
    return nearest > b.first_reaches && farthest < b.next_begins;
  }
  size_t memory_bytes() const { return texels_.size() * sizeof(Bounds); }

 private:
  struct Bounds {
    float first_reaches, next_begins;
  };
  struct Level {
    int width, height;
    size_t first;
  };
  Bounds pixel(const DepthView& view, const DepthLayers& layers, FreeSpace rule, int x, int y) const;

  std::vector<Level> levels_;
  std::vector<Bounds> texels_;
};

}  // namespace hybray::ssrm
