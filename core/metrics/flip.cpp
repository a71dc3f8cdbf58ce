#include "core/metrics/flip.h"

#include "core/base/parallel.h"
#include "core/metrics/flip_color.h"
#include "core/metrics/flip_kernels.h"
#include "core/metrics/radiance_check.h"
#include "core/metrics/row_sums.h"

#include <algorithm>
#include <cmath>

namespace hybray::metrics {
namespace {

using Plane = Image2D<float>;

constexpr float kColorExponent = 0.7f, kFeatureExponent = 0.5f;  // q_c, q_f
constexpr float kKneeOfMost = 0.4f, kValueAtKnee = 0.95f;        // p_c, p_t

template <class Row>
void for_rows(int height, const Row& row) {
  parallel_blocks(static_cast<size_t>(height), 4, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y) row(static_cast<int>(y));
  });
}

// Horizontally by one kernel, vertically by another of the same radius; beyond the border lies the border's
// colour. Loops run over pixels inside and taps outside, which is what makes them vectors.
Plane filtered(const Plane& in, const Kernel& across, const Kernel& down) {
  const int w = in.width(), h = in.height(), taps = static_cast<int>(across.size()), radius = taps / 2;
  Plane between(w, h), out(w, h);
  for_rows(h, [&](int y) {
    std::vector<float> padded(static_cast<size_t>(w + 2 * radius));
    for (int i = 0; i < w + 2 * radius; ++i)
      padded[static_cast<size_t>(i)] = in(std::clamp(i - radius, 0, w - 1), y);
    float* sum = &between(0, y);
    for (int k = 0; k < taps; ++k) {
      const float weight = across[static_cast<size_t>(k)];
      const float* from = padded.data() + k;
      for (int x = 0; x < w; ++x) sum[x] += weight * from[x];
    }
  });
  for_rows(h, [&](int y) {
    float* sum = &out(0, y);
    for (int k = 0; k < taps; ++k) {
      const float weight = down[static_cast<size_t>(k)];
      const float* from = &between(0, std::clamp(y + k - radius, 0, h - 1));
      for (int x = 0; x < w; ++x) sum[x] += weight * from[x];
    }
  });
  return out;
}

// Strength of one kind of feature: length of the vector of its two directions.
Plane strength(const Plane& y, const Kernel& derivative, const Kernel& smooth) {
  Plane across = filtered(y, derivative, smooth);
  const Plane down = filtered(y, smooth, derivative);
  for (size_t i = 0; i < across.size(); ++i) across[i] = std::sqrt(across[i] * across[i] + down[i] * down[i]);
  return across;
}

// One image as an observer sees it: colour, and how strong an edge and a point each pixel is.
struct Seen {
  Image2D<vec3> lab;
  Plane edge, point;
};

Seen seen(const Image2D<vec3>& image, const FlipKernels& kernels) {
  const int w = image.width(), h = image.height();
  Plane y(w, h), cx(w, h), cz(w, h);
  for_rows(h, [&](int row) {
    for (int x = 0; x < w; ++x) {
      const auto opponent = flip_color::opponent_of(glm::min(image(x, row), 1.0f));
      y(x, row) = opponent.y, cx(x, row) = opponent.cx, cz(x, row) = opponent.cz;
    }
  });
  Seen result{Image2D<vec3>(w, h), strength(y, kernels.edge, kernels.smooth),
              strength(y, kernels.point, kernels.smooth)};
  y = filtered(y, kernels.achromatic, kernels.achromatic);
  cx = filtered(cx, kernels.red_green, kernels.red_green);
  const Plane wide = filtered(cz, kernels.blue_yellow[0], kernels.blue_yellow[0]);
  cz = filtered(cz, kernels.blue_yellow[1], kernels.blue_yellow[1]);
  for_rows(h, [&](int row) {
    for (int x = 0; x < w; ++x)
      result.lab(x, row) = flip_color::hunt_lab_of({y(x, row), cx(x, row), wide(x, row) + cz(x, row)});
  });
  return result;
}

// The greatest colour difference on the display, between green and blue, to the power q_c.
float greatest_difference() {
  const auto lab = [](const vec3& rgb) { return flip_color::hunt_lab_of(flip_color::opponent_of(rgb)); };
  return std::pow(flip_color::hyab(lab({0.0f, 1.0f, 0.0f}), lab({0.0f, 0.0f, 1.0f})), kColorExponent);
}

}  // namespace

Image2D<float> flip(const Image2D<vec3>& image, const Image2D<vec3>& reference, double pixels_per_degree) {
  require_radiance(reference, "reference");
  require_size(image, "image", reference.width(), reference.height(), "the reference");
  require_radiance(image, "image");
  const FlipKernels kernels = flip_kernels(pixels_per_degree);
  const Seen test = seen(image, kernels), truth = seen(reference, kernels);
  const float most = greatest_difference(), knee = kKneeOfMost * most;
  const float half = std::sqrt(0.5f);
  Image2D<float> error(image.width(), image.height());
  for_rows(image.height(), [&](int y) {
    for (int x = 0; x < image.width(); ++x) {
      const float apart = std::pow(flip_color::hyab(truth.lab(x, y), test.lab(x, y)), kColorExponent);
      // Small differences are spread over most of [0, 1], the great ones share the rest.
      const float color = apart < knee
                              ? apart * (kValueAtKnee / knee)
                              : kValueAtKnee + (apart - knee) / (most - knee) * (1.0f - kValueAtKnee);
      const float feature = std::pow(half * std::max(std::abs(truth.edge(x, y) - test.edge(x, y)),
                                                     std::abs(truth.point(x, y) - test.point(x, y))),
                                     kFeatureExponent);
      // Rounding may leave either above 1, by an ulp.
      error(x, y) = std::pow(std::min(color, 1.0f), 1.0f - std::min(feature, 1.0f));
    }
  });
  return error;
}

double mean_error(const Image2D<float>& error) {
  const auto [sum] = sum_rows<1>(error.height(), [&](int y) {
    double row = 0.0;
    for (int x = 0; x < error.width(); ++x) row += static_cast<double>(error(x, y));
    return std::array{row};
  });
  return sum / static_cast<double>(error.size());
}

}  // namespace hybray::metrics
