// What a screen-space march must find, in double precision from the geometry on: pixels as planes in 1/w,
// mirror rays from the surface itself, the walk through every pixel and its closer look, without device depth
// and its encoding, float rays or offsets. Taken over are the vertices, which primitive a pixel sees, and
// what is in double anyway and tested for itself: View, the planes of triangle_plane.h, geometric normals.
#pragma once

#include "core/base/image2d.h"
#include "core/gbuffer/view.h"
#include "core/scene/scene.h"
#include "core/ssrm/correction.h"
#include "core/ssrm/march_options.h"

#include <optional>
#include <vector>

namespace hybray::truth {

class ExactFrame {
 public:
  // `primitive`: what each pixel of `view` sees at its centre, kNoPrimitive for nothing; kept. All threads.
  ExactFrame(const Scene& scene, const View& view, Image2D<uint32_t> primitive);

  const Scene& scene() const { return scene_; }
  const View& view() const { return view_; }
  const Image2D<uint32_t>& primitive() const { return primitive_; }
  // View depth, metres, at the centre of a pixel; infinity where it sees nothing.
  double view_depth(uint32_t pixel) const { return -1.0 / planes_[pixel].center; }

  // The mirror ray of a pixel that sees something: from the surface itself, and in screen space with -1/w as
  // its depth. Nothing where the pixel's plane is seen edge-on.
  struct Ray {
    dvec3 origin{0.0}, direction{0.0};
    ssrm::ScreenRay<double> screen{};
    uint32_t pixel = 0;
  };
  std::optional<Ray> mirror_ray(uint32_t pixel) const;

  // The verdict of a walk through every pixel, by the rules of `marcher` (docs/metrics.md,
  // docs/algorithms.md).
  ssrm::Correction march(const Ray& ray, ssrm::Marcher marcher) const;

  // Distance, metres, at which a ray meets the plane of a pixel that it goes through.
  double distance(const Ray& ray, uint32_t pixel) const;

 private:
  struct Span {
    double enter, leave;
  };
  Span span(const ssrm::ScreenRay<double>& ray, int x, int y) const;
  // How far behind the plane of a pixel the ray is at parameter l, in -1/w.
  double gap(const ssrm::ScreenRay<double>& ray, int x, int y, double l) const;
  double slack(int x, int y) const;
  bool passes(const ssrm::ScreenRay<double>& ray, int x, int y) const;
  void end_ray(Ray& ray) const;
  uint32_t index(int x, int y) const { return view_.pixel_index(x, y); }

  const Scene& scene_;
  View view_;
  Image2D<uint32_t> primitive_;
  Image2D<ssrm::PixelPlane> planes_;
};

}  // namespace hybray::truth
