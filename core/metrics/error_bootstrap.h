// Confidence intervals of relMSE and energy ratio by the bootstrap over batches (Efron 1979): over the
// independent images of the method and over the independent batches of the reference.
//
// Averaging images again for thousands of resamples would be slow. It is enough to know how they differ from
// the reference in the inner product that relMSE is made of, <a, b> = mean(a b / (r^2 + e)): with y = x - r
// of each method image and d_k = r_k - r of each reference batch, a reference resampled with counts c_k is r
// + sum c_k d_k / R, and its distance to x follows from <y, y>, <y, d_k> and <d_k, d_l>. So each method image
// is reduced to R + 2 numbers when it is added. The weights 1 / (r^2 + e) stay those of the full reference.
#pragma once

#include "core/base/image2d.h"
#include "core/base/vec.h"
#include "core/metrics/statistics.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hybray::metrics {

struct ErrorIntervals {
  // relMSE of one image of the method: the mean over its images. A resampled reference has its noise twice;
  // the second time is taken out, so that the interval lies about the value.
  Interval relmse;
  Interval relmse_debiased;       // less reference_relmse; the interval moves with it
  Interval energy_ratio;          // mean energy of the method's images / energy of the reference
  double reference_relmse = 0.0;  // of the mean of all batches; 0 for an exact reference
};

class ErrorBootstrap {
 public:
  // Against the mean of at least 2 independent batches, which the caller keeps alive and unchanged. Where
  // `mask` is given, only pixels where it is not zero count; it is copied. Throws InputError for what
  // image_error refuses.
  explicit ErrorBootstrap(std::span<const Image2D<vec3>> batches, const Image2D<uint8_t>* mask = nullptr);

  // Against an exact image: only the method's images are resampled.
  static ErrorBootstrap against_exact(const Image2D<vec3>& reference, const Image2D<uint8_t>* mask = nullptr);

  // Adds one independent image of the method; it is not kept. Throws InputError as image_error does.
  void add(const Image2D<vec3>& image);
  size_t images() const { return images_.size(); }

  // 95 % percentile intervals, the same for the same seed. Throws InputError for fewer than 2 images.
  ErrorIntervals intervals(uint64_t seed, int resamples = 2000) const;

 private:
  struct MethodImage {
    double square;              // <y, y>
    std::vector<double> cross;  // <y, d_k> by reference batch
    double energy;              // sum over pixels and channels
  };

  ErrorBootstrap(Image2D<vec3> reference, std::span<const Image2D<vec3>> batches,
                 const Image2D<uint8_t>* mask);
  bool counts(int x, int y) const { return mask_.empty() || mask_(x, y); }
  // <a - r, b - r>
  double product(const Image2D<vec3>& a, const Image2D<vec3>& b) const;
  double energy(const Image2D<vec3>& image) const;

  Image2D<vec3> reference_;  // r
  std::span<const Image2D<vec3>> batches_;
  Image2D<uint8_t> mask_;  // empty: all pixels
  double floor_ = 0.0;     // e
  double entries_ = 0.0;   // pixels that count x channels
  double reference_energy_ = 0.0;
  std::vector<double> batch_energy_;
  std::vector<double> gram_;  // <d_k, d_l>, R x R
  std::vector<MethodImage> images_;
};

}  // namespace hybray::metrics
