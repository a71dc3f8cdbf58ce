// Marching lists of rays, by whichever marcher the options name.
#pragma once

#include "core/ssrm/correction.h"
#include "core/ssrm/march_options.h"
#include "core/ssrm/ray_choice.h"

#include <span>
#include <vector>

namespace hybray::ssrm {

// Every ray, all threads. `pixels` holds each ray's own pixel (RayStream::pixel); the march starts at the
// exit of that pixel. `results` is resized by the caller to rays.size(). Marcher `plane` needs view.slanted.
void march(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
           const MarchOptions& options, MarchResults& results);

// The same for the rays listed in `which` (indices into `rays`), each result written to its own place; other
// places are not touched.
void march_some(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                std::span<const uint32_t> which, const MarchOptions& options, MarchResults& results);

// The same for any choice of rays.
void march_chosen(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                  const RayChoice& choice, const MarchOptions& options, MarchResults& results);

// One ray, scalar code. Adds the depth samples read to `steps`.
Correction march_ray(const DepthView& view, const ScreenRay<float>& ray, uint32_t pixel,
                     const MarchOptions& options, uint64_t& steps);

}  // namespace hybray::ssrm
