// LDR-FLIP: how different two images look when one switches between them on a display. P. Andersson, J.
// Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. D. Fairchild: FLIP: A Difference Evaluator for
// Alternating Images, Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020. Own implementation from the paper,
// with separable filters.
#pragma once

#include "core/base/image2d.h"
#include "core/base/vec.h"

namespace hybray::metrics {

// A display 0.7 m wide, 3840 pixels across, seen from 0.7 m: the paper's.
constexpr double kFlipPixelsPerDegree = 67.0;

// Error of every pixel, 0 (looks the same) to 1 (black against white looks 0.97 different, green against blue
// 1). Both images are linear RGB with the primaries of sRGB, as a display shows them: values above 1 count
// as 1. The same image at any thread count. Throws InputError for images of different size or without pixels,
// NaN, infinity, negative values, and `pixels_per_degree` outside [1, 1000].
Image2D<float> flip(const Image2D<vec3>& image, const Image2D<vec3>& reference,
                    double pixels_per_degree = kFlipPixelsPerDegree);

// Mean over the pixels, in double; at least one pixel.
double mean_error(const Image2D<float>& error);

}  // namespace hybray::metrics
