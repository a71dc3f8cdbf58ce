// Converged caustics to hold the maps against. Illumination caustics: light tracing from a defensive mixture
// of map and uniform emission (Owen and Zhou 2000), first surfaces traced, visibility by shadow rays, so that
// nothing that the map misses is missed here. Mixed caustics: progressive photon mapping in the memoryless
// form (Knaus and Zwicker 2011), each pass with its own camera paths, anywhere in the pixel.
//
// A reference is a number of independent batches: their spread is its error. Photon mapping is biased
// besides; every batch has the same estimate with twice the area of the integration spheres, and as the bias
// grows with the area, the difference between the two is the bias.
#pragma once

#include "core/caustics/caustic_pass.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hybray::truth {

// Of the numbers in a batch, which caches outlive the program. To be raised with every change that moves a
// bit of them, in whatever file it is made: sampling, optics, deposit. A test pins the numbers.
constexpr int kEstimatorVersion = 2;

struct CausticReferenceSettings {
  double paths = 4e6;            // of one batch, over all lights; >= 1
  int map_resolution = 512;      // of the maps behind the mixture
  int max_events = 64;           // specular events; what is cut off is in the ledger
  bool mixed = true;             // caustics seen through specular surfaces as well
  int passes = 4;                // of one batch; each takes its share of the paths
  double radius_pixels = 2.0;    // of the integration spheres in the first pass
  int camera_paths = 1;          // of each pixel and pass
  std::vector<uint32_t> lights;  // into Scene::lights
  TraceMode mode = TraceMode::packet16_coherent;
  uint64_t seed = 1;
};

// All settings and kEstimatorVersion as one line of text: equal texts give equal batches of the same scene,
// tracer and view.
std::string describe(const CausticReferenceSettings& settings);

struct CausticReferenceBatch {
  Image2D<vec3> illumination;  // W/(sr m^2); width x height of the view
  Image2D<vec3> mixed;         // empty where the camera sees no specular surface, or not asked for
  Image2D<vec3> mixed_wide;    // the same with integration spheres of twice the area
  caustics::FluxLedger ledger;
  caustics::SplatCounts counts;
  uint64_t rays = 0, paths = 0;
  uint64_t overflows = 0;  // of the accumulators: 0 unless the images are wrong
};

class CausticReference {
 public:
  // `scene` should have a robust tracer; it and `camera` must outlive the reference. The G-buffer must hold
  // depth and primitives.
  CausticReference(const caustics::CausticScene& scene, const GBuffer& camera,
                   const CausticReferenceSettings& settings);

  // Batch number `batch`, a pure function of it and the settings.
  CausticReferenceBatch batch(uint32_t batch) const;

  const caustics::MapSet& maps() const { return maps_; }

 private:
  struct Images;
  void trace_pass(uint32_t batch, int pass, const caustics::BackwardMap* seen, Images& images,
                  CausticReferenceBatch& result) const;

  const caustics::CausticScene& scene_;
  const GBuffer& camera_;
  CausticReferenceSettings settings_;
  caustics::MapSet maps_;
  std::vector<double> light_paths_;  // of each map in one pass
  bool mixed_ = false;
  uint16_t camera_medium_ = 0;
};

}  // namespace hybray::truth
