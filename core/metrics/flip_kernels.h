// The filters of FLIP (Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem and Fairchild 2020, Section 4)
// as one-dimensional kernels: each of the paper's two-dimensional ones is a product of two of these, or, for
// the blue-yellow channel, a sum of two such products.
#pragma once

#include <vector>

namespace hybray::metrics {

// Weights at -r, ..., r.
using Kernel = std::vector<float>;

struct FlipKernels {
  // Contrast sensitivity of achromatic, red-green and blue-yellow. The last is
  // blue_yellow[0] x blue_yellow[0] + blue_yellow[1] x blue_yellow[1]; all sum to 1 in two dimensions.
  Kernel achromatic, red_green, blue_yellow[2];
  // A Gaussian as wide as an edge seems to people, its first derivative, which finds edges, and its second,
  // which finds points. The positive and the negative weights of a derivative sum to 1 and -1.
  Kernel smooth, edge, point;
};

// Throws InputError for `pixels_per_degree` outside [1, 1000].
FlipKernels flip_kernels(double pixels_per_degree);

}  // namespace hybray::metrics
