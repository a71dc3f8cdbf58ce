// A guard band: buffers that reach beyond the screen on every side, so that rays find what lies just outside.
#pragma once

#include "core/gbuffer/gbuffer.h"

namespace hybray {

// Pixels of a band on each side of `size` pixels: at least `fraction` of them, up to a whole number of tiles
// (8), so that tiles and packets stay where they are.
int guard_band(int size, double fraction);

// Buffers of `inner` with `margin` more pixels on each side (whole tiles): the inner ones copied, only the
// band is traced. All kinds of buffer that `inner` has. covered_pixels counts the whole.
GBuffer with_guard_band(const Tracer& tracer, const GBuffer& inner, ivec2 margin);

}  // namespace hybray
