// HDR-FLIP: the worst LDR-FLIP over the exposures at which one may look at an image of high dynamic range.
// P. Andersson, J. Nilsson, P. Shirley, T. Akenine-Moeller: Visualizing Errors in Rendered High Dynamic Range
// Images, Eurographics short papers 2021. Tone mapping: ACES by Narkowicz's fit, as there.
#pragma once

#include "core/metrics/flip.h"

namespace hybray::metrics {

// Exposures in stops, binary logarithms of the factors on radiance: `count` of them, evenly from start to
// stop.
struct FlipExposures {
  double start = 0.0, stop = 0.0;
  int count = 1;
};

// The exposures at which a reference is looked at; every image that is held against it takes the same ones.
// By the paper, Section 2.1, from the exposure at which the brightest pixel comes to 85 % of white to that at
// which the median pixel does, in steps of at most about a stop, at least 2.
//
// Where more than half of the image is black the paper's median is 0, its exposure infinite. So the median is
// taken over pixels of at least kFloorFraction (1 %) of the mean luminance alone where that of all lies
// below; elsewhere it is the paper's. Throws InputError for an image that is black everywhere, and as
// image_error does.
FlipExposures flip_exposures(const Image2D<vec3>& reference);

// The factor on radiance before filmic() (core/base/develop.h) that shows it at an exposure.
float exposure_factor(double stops);

// Error of every pixel: the greatest over the exposures. Linear radiance with the primaries of sRGB. Throws
// InputError as flip() does, and for start > stop, values that are not finite and a count below 1.
Image2D<float> hdr_flip(const Image2D<vec3>& image, const Image2D<vec3>& reference,
                        const FlipExposures& exposures, double pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace hybray::metrics
