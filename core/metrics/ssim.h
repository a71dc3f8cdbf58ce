// Errors of images as a display shows them.
//
// SSIM: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli: Image Quality Assessment: From Error Visibility
// to Structural Similarity, IEEE Trans. Image Processing 13(4), 2004.
#pragma once

#include "core/base/image2d.h"
#include "core/base/vec.h"

namespace hybray::metrics {

constexpr int kSsimWindow = 11;  // pixels along one side

// Structural similarity, 1 for the same image: mean over all windows that lie inside the image, and over the
// channels. Windows are 11 x 11 Gaussians of sigma 1.5, K1 = 0.01, K2 = 0.03, `range` is the L of the paper:
// the difference of the greatest and the least value that there can be. Throws InputError for images of
// different size or smaller than 11 x 11, NaN, infinity, negative values, and a range that is not positive.
double ssim(const Image2D<vec3>& image, const Image2D<vec3>& reference, double range = 1.0);

// Peak signal-to-noise ratio, dB: 10 log10(range^2 / mean((x - r)^2)) over pixels and channels; infinity for
// the same image. Throws InputError as ssim() does, but takes any size from 1 x 1.
double psnr(const Image2D<vec3>& image, const Image2D<vec3>& reference, double range = 1.0);

}  // namespace hybray::metrics
