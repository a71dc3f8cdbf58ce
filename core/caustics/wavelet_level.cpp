#include "core/caustics/wavelet_level.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace hybray::caustics {
namespace {

constexpr float kSpline[5] = {1.0f / 16, 4.0f / 16, 6.0f / 16, 4.0f / 16, 1.0f / 16};  // B3
constexpr float kCentre = kSpline[2] * kSpline[2];
// Keeps pixels of equal luminance and no noise apart from a division by zero; luminance is in [0, 1].
constexpr float kLeastVariance = 1e-20f;

constexpr float kCutOff = 8.0f;

// exp(-t) as (1 - t / 8)^8: zero beyond t = 8, so that nothing at all leaks across an edge, and the same bits
// on every machine, which a library's exp does not promise.
inline float falloff(float t) {
  float w = 1.0f - t / kCutOff;
  w = 0.5f * (w + std::abs(w));  // max(0, w), exactly, without the branch that stops vectorisation
  w *= w;
  w *= w;
  return w * w;
}

// Weights of the taps q = p + offset for p in [begin, end), kernel included.
void tap_weights(const FilterGuide& g, const LuminanceGuide* luminance, size_t begin, size_t end,
                 ptrdiff_t offset, float kernel, float* __restrict weights) {
  const float *px = g.point_x.data(), *py = g.point_y.data(), *pz = g.point_z.data();
  const float *nx = g.plane_x.data(), *ny = g.plane_y.data(), *nz = g.plane_z.data();
  const float *sx = g.normal_x.data(), *sy = g.normal_y.data(), *sz = g.normal_z.data();
  const float* inverse = g.inverse_sigma.data();
  const uint32_t* material = g.material.data();
  for (size_t p = begin; p < end; ++p) {
    const size_t q = p + static_cast<size_t>(offset);
    const float dx = px[q] - px[p], dy = py[q] - py[p], dz = pz[q] - pz[p];
    const float from_p = dx * nx[p] + dy * ny[p] + dz * nz[p], from_q = dx * nx[q] + dy * ny[q] + dz * nz[q];
    const float cosine = sx[p] * sx[q] + sy[p] * sy[q] + sz[p] * sz[q];
    // -log cos = 1 - cos to first order; rounding can put the cosine above 1.
    const float turned = std::abs(1.0f - cosine);
    const float t = g.normal_power * turned + (from_p * from_p + from_q * from_q) * (inverse[p] * inverse[q]);
    weights[p - begin] = t + (material[p] == material[q] ? 0.0f : kCutOff);
  }
  if (luminance) {
    const float *l = luminance->luminance.data(), *allowed = luminance->allowed.data();
    for (size_t p = begin; p < end; ++p) {
      const size_t q = p + static_cast<size_t>(offset);
      const float apart = l[q] - l[p];
      weights[p - begin] += apart * apart / (allowed[p] + allowed[q] + kLeastVariance);
    }
  }
  for (size_t i = 0; i < end - begin; ++i) weights[i] = kernel * falloff(weights[i]);
}

template <size_t Channels>
void filter_row(const Planes<Channels>& in, Planes<Channels>& out, const FilterGuide& g,
                const LuminanceGuide* luminance, int step, int y) {
  const int width = g.width;
  const size_t row = static_cast<size_t>(y) * static_cast<size_t>(width), n = static_cast<size_t>(width);
  std::vector<float> weights(n), sum(n, kCentre);
  std::array<std::vector<float>, Channels> gain;
  gain.fill(std::vector<float>(n, 0.0f));
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i) {
      const int64_t dx = int64_t{i} * step, dy = int64_t{j} * step;
      if ((i == 0 && j == 0) || y + dy < 0 || y + dy >= g.height) continue;
      const int64_t first = std::max<int64_t>(0, -dx), last = std::min<int64_t>(width, width - dx);
      if (first >= last) continue;
      const auto begin = static_cast<size_t>(first), count = static_cast<size_t>(last - first);
      const ptrdiff_t offset = dy * width + dx;
      tap_weights(g, luminance, row + begin, row + begin + count, offset, kSpline[i + 2] * kSpline[j + 2],
                  weights.data());
      for (size_t k = 0; k < count; ++k) sum[begin + k] += weights[k];
      for (size_t c = 0; c < Channels; ++c) {
        const float *p = in[c].data() + row + begin, *q = p + offset;
        float* total = gain[c].data() + begin;
        for (size_t k = 0; k < count; ++k) total[k] += weights[k] * (q[k] - p[k]);
      }
    }
  for (size_t x = 0; x < n; ++x) {
    const bool background = g.material[row + x] == kNoPrimitive;
    const float scale = background ? 0.0f : g.gather ? 1.0f / sum[x] : 1.0f;
    for (size_t c = 0; c < Channels; ++c) {
      const float value = in[c][row + x] + scale * gain[c][x];
      // Rounding of a convex combination can fall below zero by an ulp of its largest term; NaN stays NaN.
      out[c][row + x] = value < 0.0f ? 0.0f : value;
    }
  }
}

}  // namespace

FilterGuide::FilterGuide(const GBuffer& gbuffer, const WaveletFilterSettings& settings)
    : width(gbuffer.view.width()),
      height(gbuffer.view.height()),
      normal_power(settings.normal_power),
      gather(settings.normalisation == FilterNormalisation::gather),
      material(gbuffer.material.begin(), gbuffer.material.end()) {
  for (auto* plane : {&point_x, &point_y, &point_z, &plane_x, &plane_y, &plane_z, &normal_x, &normal_y,
                      &normal_z, &inverse_sigma})
    plane->resize(size());
  const View& view = gbuffer.view;
  parallel_blocks(static_cast<size_t>(height), 8, [&](size_t begin, size_t end) {
    for (size_t i = begin * static_cast<size_t>(width); i < end * static_cast<size_t>(width); ++i) {
      if (material[i] == kNoPrimitive) continue;
      const int x = static_cast<int>(i % static_cast<size_t>(width)),
                y = static_cast<int>(i / static_cast<size_t>(width));
      const double w = view.view_depth_of(gbuffer.depth[i]);
      const vec3 point(w * view.ray_direction(x + 0.5, y + 0.5));
      const vec3 plane = gbuffer.geometric_normal[i], normal = gbuffer.shading_normal[i];
      point_x[i] = point.x, point_y[i] = point.y, point_z[i] = point.z;
      plane_x[i] = plane.x, plane_y[i] = plane.y, plane_z[i] = plane.z;
      normal_x[i] = normal.x, normal_y[i] = normal.y, normal_z[i] = normal.z;
      inverse_sigma[i] = static_cast<float>(view.focal() / (w * settings.plane_sigma));
    }
  });
}

template <size_t Channels>
Planes<Channels> wavelet_level(const Planes<Channels>& image, const FilterGuide& guide,
                               const LuminanceGuide* luminance, int level) {
  Planes<Channels> out;
  for (auto& plane : out) plane.resize(guide.size());
  parallel_blocks(static_cast<size_t>(guide.height), 4, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y)
      filter_row(image, out, guide, luminance, 1 << level, static_cast<int>(y));
  });
  return out;
}

template Planes<1> wavelet_level(const Planes<1>&, const FilterGuide&, const LuminanceGuide*, int);
template Planes<2> wavelet_level(const Planes<2>&, const FilterGuide&, const LuminanceGuide*, int);
template Planes<3> wavelet_level(const Planes<3>&, const FilterGuide&, const LuminanceGuide*, int);

}  // namespace hybray::caustics
