// The colour map `magma` of N. Smith and S. van der Walt (matplotlib, 2015, CC0): its brightness rises
// evenly, so that an error map reads the same in grey.
#pragma once

#include "core/base/image2d.h"

#include <cstdint>
#include <vector>

namespace hybray::metrics {

// width x height pixels of 8-bit sRGB, row by row: black at 0, light yellow at 1; clamped. Within 0.01 of the
// published table of 256 colours.
std::vector<uint8_t> magma(const Image2D<float>& values);

}  // namespace hybray::metrics
