// Procedural scenes: deterministic functions of their parameters, each with named cameras inside at eye
// level.
#pragma once

#include "core/scene/scene.h"

#include <cstdint>
#include <span>
#include <string>

namespace hybray::procedural {

struct Parameters {
  uint32_t triangles =
      0;  // wanted number of triangles, met to within a few per cent; 0 = the generator's own default
  uint32_t seed = 1;  // of everything that varies at random
};

struct Generator {
  const char* name;
  const char* text;            // one line of what it shows
  uint32_t default_triangles;  // 1,024 (sphere), 2^18 (atrium), 2^20 (street)
  Scene (*generate)(const Parameters&);
};

// All generators, by name.
std::span<const Generator> generators();

Scene sphere(const Parameters& parameters);
Scene atrium(const Parameters& parameters);
Scene street(const Parameters& parameters);

}  // namespace hybray::procedural
