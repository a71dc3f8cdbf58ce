// Density estimation of caustics seen through specular surfaces, from photons and visibility points: backward
// maps scatter from the light path, forward maps gather at the camera path (caustics paper, "Mixed caustics",
// Figure 5). Both add the same pairs, and with the fixed-point image give the same bits.
#pragma once

#include "core/caustics/fixed_point_image.h"
#include "core/caustics/grouped_tree.h"
#include "core/caustics/photon_blocks.h"
#include "core/caustics/visibility_points.h"
#include "core/optics/surface_optics.h"
#include "core/scene/scene.h"

namespace hybray::caustics {

enum class PhotonMapKind : uint8_t {
  backward,  // tree over the visibility points, every photon looks for the spheres that it lies in
  forward,   // tree over the photons, every visibility point looks for the photons in its sphere
};

struct PhotonMapCounts {
  uint64_t pairs = 0;  // of a photon and a visibility point that it counts for
  size_t tree_bytes = 0;
};

// Adds to each visibility point's pixel weight * BRDF * flux / (pi radius^2) of the photons inside its
// integration sphere and on the same side of a surface turned by less than 45 degrees. A photon counts by the
// place where it arrived, not by where its ray crosses the sphere.
PhotonMapCounts add_mixed_caustics(PhotonMapKind kind, const Scene& scene, const optics::OpticsTable& optics,
                                   const PhotonBlocks& photons, const VisibilityPoints& visible,
                                   FixedPointImage& image);

// Backward maps for photons that come in portions, over visibility points that stay: their tree is built
// once. One search can serve two radii, as the bias of photon mapping needs them.
class BackwardMap {
 public:
  // `widening` >= 1: radius of the wide spheres over that of the points. All three must outlive the map.
  BackwardMap(const Scene& scene, const optics::OpticsTable& optics, const VisibilityPoints& visible,
              float widening = 1.0f);

  // Adds to `image` what add_mixed_caustics adds, and to `wide`, where it is given, what that would add with
  // wide spheres. The pairs counted are those of `image`.
  PhotonMapCounts add(const PhotonBlocks& photons, FixedPointImage& image,
                      FixedPointImage* wide = nullptr) const;

 private:
  const optics::OpticsTable& optics_;
  const std::vector<VisibilityPoint>& points_;
  float widening_;
  GroupedTree tree_;  // over the wide spheres
};

// The greatest radiance that `flux` watts can give one pixel through these points, for the scale of a
// FixedPointImage.
double largest_radiance(double flux, const VisibilityPoints& visible);

}  // namespace hybray::caustics
