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
      0;  // wanted number of triangles (and curves), met to within a few per cent; 0 = its own default
  uint32_t seed = 1;  // of everything that varies at random
};

struct Generator {
  const char* name;
  const char* text;  // one line of what it shows
  uint32_t default_triangles;
  Scene (*generate)(const Parameters&);
  bool exact = false;  // has one form only, which no parameter changes
};

// All generators, by name.
std::span<const Generator> generators();

Scene sphere(const Parameters& parameters);
Scene atrium(const Parameters& parameters);
Scene street(const Parameters& parameters);

// Geometry on which a ray is dear.
Scene foliage(const Parameters& parameters);     // leaves cut out by masks
Scene meadow(const Parameters& parameters);      // grass and reeds as curves
Scene sculptures(const Parameters& parameters);  // bodies given by distance fields

// Scenes made for caustics: matte ground that light through glass and water, or off metal, is thrown on. All
// bodies close.
Scene atrium_lamps(const Parameters& parameters);
Scene glass_ball(const Parameters& parameters);
Scene metal_ring(const Parameters& parameters);
Scene mirror_and_floor(const Parameters& parameters);
Scene prism(const Parameters& parameters);
Scene water_pool(const Parameters& parameters);
Scene wine_glass(const Parameters& parameters);

}  // namespace hybray::procedural
