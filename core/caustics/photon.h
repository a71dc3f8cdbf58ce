// What light paths leave behind: photons on diffuse surfaces, and the account of where their flux went.
#pragma once

#include "core/base/vec.h"

#include <cstdint>

namespace hybray::caustics {

// Flux that arrived at a surface with a diffuse part after at least one specular event.
struct Photon {
  vec3 position{0.0f};  // on the surface, metres
  float cos_in = 1.0f;  // |cos| of arrival with the shading normal
  vec3 normal{0.0f};    // geometric, unit, on the side of arrival
  uint32_t material = 0;
  vec3 direction{0.0f};  // of travel, unit
  uint32_t primitive = 0;
  vec3 flux{0.0f};             // W by channel, before the surface's BRDF
  uint16_t events = 0;         // specular events before this surface
  uint16_t missed_by_map = 0;  // 1: the path left the light where its visibility map has probability zero

  // W, mean of the channels.
  double mean_flux() const {
    return (static_cast<double>(flux.x) + static_cast<double>(flux.y) + static_cast<double>(flux.z)) / 3.0;
  }

  // |cos| of arrival with the shading normal / with the geometric normal: what turns flux per area of the
  // triangle into irradiance on the smooth surface that it stands for (Veach 1997, 5.3). 1 where the shading
  // normal turns away and the geometric one stands in; 0 where the light grazes.
  float shading_ratio() const {
    const float cos_geometric = -glm::dot(direction, normal);
    return cos_geometric > 0.0f ? cos_in / cos_geometric : 0.0f;
  }
};
static_assert(sizeof(Photon) == 64);  // a cache line

// Where the flux of the paths went, W, mean of the channels, in double. By construction
//   emitted = deposited + direct + absorbed + escaped + truncated + balance
// up to rounding, and a path that is lost or counted twice breaks it.
struct FluxLedger {
  double emitted = 0.0;    // sum of the initial weights
  double deposited = 0.0;  // entered a diffuse part after a specular event
  double direct = 0.0;     // entered a diffuse part before any: direct light, not a caustic
  double absorbed = 0.0;   // by metals, tints, media and black surfaces
  double escaped = 0.0;    // left the scene
  double truncated = 0.0;  // cut off by the greatest number of specular events
  double balance = 0.0;    // taken less given by the random choices: zero on average

  double total() const { return deposited + direct + absorbed + escaped + truncated + balance; }
  void add(const FluxLedger& o) {
    emitted += o.emitted, deposited += o.deposited, direct += o.direct, absorbed += o.absorbed;
    escaped += o.escaped, truncated += o.truncated, balance += o.balance;
  }
};

}  // namespace hybray::caustics
