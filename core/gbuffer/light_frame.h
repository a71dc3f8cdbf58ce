// The image planes of a light: six cube faces around a point light, a frustum for a spot light, and an
// orthographic frame for a directional light. Shadow maps and every other buffer seen from a light use the
// same.
//
// Texels: (0, 0) is the top left corner, texel (x, y) covers [x, x+1) x [y, y+1).
#pragma once

#include "core/base/vec.h"
#include "core/scene/light.h"

#include <cmath>
#include <span>
#include <vector>

namespace hybray {

struct LightFrame {
  bool orthographic = false;
  dvec3 origin{0.0};  // the light; orthographic: centre of a plane that the whole scene lies beyond
  dvec3 right{0.0}, down{0.0}, forward{0.0};   // unit
  double half_width = 1.0, half_height = 1.0;  // tangents of the half angles; orthographic: metres
  int width = 0, height = 0;                   // texels

  size_t texels() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }

  // The ray through image point (x, y); directions have unit length.
  dvec3 ray_origin(double x, double y) const;
  dvec3 ray_direction(double x, double y) const;

  // Solid angle (orthographic: area, m^2) of the image per texel area at (x, y).
  double measure_density(double x, double y) const;
  // Solid angle of texel (x, y), sr, exact (four corners); orthographic: its area, m^2.
  double texel_measure(int x, int y) const;

  // Image point of a world point. Returns false where it is behind the light or outside the image.
  bool project(const dvec3& world, dvec2& image) const;
};

// The rays of a frame, one after the other: what does not depend on the image point is worked out once.
struct FrameRays {
  dvec3 origin{0.0}, forward{0.0};
  dvec3 corner{0.0}, step_x{0.0},
      step_y{0.0};    // of points on the plane at distance 1; orthographic: of origins
  double area = 0.0;  // of a texel on that plane
  bool orthographic = false;

  FrameRays() = default;
  explicit FrameRays(const LightFrame& frame);
  // The ray through image point (x, y), and the measure_density there.
  void ray(double x, double y, dvec3& ray_origin, dvec3& ray_direction, double& density) const {
    const dvec3 point = corner + x * step_x + y * step_y;
    density = area;
    if (orthographic) {
      ray_origin = point;
      ray_direction = forward;
      return;
    }
    const double scale = 1.0 / std::sqrt(glm::dot(point, point));
    ray_origin = origin;
    ray_direction = scale * point;
    density *= scale * scale * scale;
  }
};

// The frames of `light`, each resolution x resolution texels. `targets` are boxes around what is to be seen:
// frames that see none of them are left out, and the orthographic frame is fitted to them. A spot light whose
// cone is wider than 90 degrees gets the cube faces that its cone reaches. Empty without targets.
std::vector<LightFrame> light_frames(const Light& light, std::span<const Bounds3> targets,
                                     const Bounds3& scene, int resolution);

// For each 8x8 tile of the frame, row by row, whether it may see one of the boxes (conservative).
std::vector<uint8_t> tiles_that_may_see(const LightFrame& frame, std::span<const Bounds3> targets);

// Completes unit `forward` to an orthonormal basis: right x down = forward.
void basis_around(const dvec3& forward, dvec3& right, dvec3& down);

}  // namespace hybray
