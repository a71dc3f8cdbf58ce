// Which medium a light or a camera lies in.
#pragma once

#include "core/optics/surface_optics.h"
#include "core/tracer/tracer.h"

namespace hybray::caustics {

// Index into OpticsTable::media of the medium around `point`: by the side of the first interface met along
// each of a few directions, by majority; vacuum where none is met.
uint16_t medium_at(const Tracer& tracer, const optics::OpticsTable& optics, const dvec3& point);

}  // namespace hybray::caustics
