// The SSRM paper's figure: mirror reflections by screen-space marching, coloured by verdict.
#pragma once

#include "core/gbuffer/gbuffer.h"
#include "core/metrics/verdict_table.h"
#include "harness/experiments/experiment.h"

#include <functional>
#include <vector>

namespace hybray {

// Writes pictures/SCENE_CAMERA_WIDTHxHEIGHT_ID.png below the run's folder. Grey: right HITs, as bright as the
// reflected surface facing the ray; red: false HITs; blue: UNKNOWN; light blue: MISS; black: background.
// Beside it ..._ID_view.png: the main view, as bright as its surfaces facing the eye. The G-buffer must hold
// primitives.
void write_verdict_picture(const Point& point, const Workspace& workspace, const GBuffer& gbuffer,
                           const Scene& scene, const RayStream& rays, const ssrm::MarchResults& results,
                           const std::vector<metrics::HitClass>& classes);

// The same where pixels of `results` are those of another view than the rays', and the surface of a HIT is
// `primitive_of` its ray.
void write_verdict_picture(const Point& point, const Workspace& workspace, const GBuffer& gbuffer,
                           const Scene& scene, const RayStream& rays, const ssrm::MarchResults& results,
                           const std::vector<metrics::HitClass>& classes, const View& march_view,
                           const std::function<uint32_t(size_t ray)>& primitive_of);

}  // namespace hybray
