#include "core/scene/procedural/generators.h"

#include "core/scene/procedural/closed_form_scenes.h"
#include "core/scene/procedural/corner.h"
#include "core/scene/procedural/exact_scene.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace hybray::procedural {

std::span<const Generator> generators() {
  static constexpr std::array<Generator, 14> kGenerators{{
      {"atrium", "two-storey colonnaded hall with arches, vaults, drapes and a gallery, 30 m long",
       uint32_t{1} << 18, atrium},
      {"atrium_lamps", "the atrium by night, with 8 lamps in sight and 8 out of it, by glass and metal",
       uint32_t{3} << 17, atrium_lamps},
      {"corner", "a floor before a wall, with a few blocks: large flat faces only", 36, exact<corner>, true},
      {"foliage", "clearing among trees, bushes and ferns whose leaves are cut out by masks",
       uint32_t{3} << 17, foliage},
      {"glass_ball", "solid glass ball above a matte floor, with a point light", uint32_t{1} << 15,
       glass_ball},
      {"meadow", "meadow with a pond, whose grass and reeds are curves", uint32_t{3} << 16, meadow},
      {"metal_ring", "polished gold and silver rings on a table", uint32_t{1} << 15, metal_ring},
      {"mirror_and_floor", "plane mirrors that throw a patch of light and show a glass ball's caustic",
       uint32_t{1} << 15, mirror_and_floor},
      {"prism", "solid glass prism in a narrow beam", uint32_t{1} << 13, prism},
      {"sculptures", "court with rings, gyroids and melted balls given by distance fields", uint32_t{1} << 14,
       sculptures},
      {"sphere", "a sphere in a small walled court", uint32_t{1} << 10, sphere},
      {"street", "town street with facades, awnings, a square and many small objects, 90 m long",
       uint32_t{1} << 20, street},
      {"water_pool", "tiled pool under waves in the sun", uint32_t{1} << 16, water_pool},
      {"wine_glass", "glass of red wine on a table under a spot light", uint32_t{3} << 14, wine_glass},
  }};
  static const std::vector<Generator> kAll = [] {
    std::vector<Generator> all(kGenerators.begin(), kGenerators.end());
    const std::span<const Generator> closed_forms = closed_form_generators();
    all.insert(all.end(), closed_forms.begin(), closed_forms.end());
    std::sort(all.begin(), all.end(),
              [](const Generator& a, const Generator& b) { return std::string_view(a.name) < b.name; });
    return all;
  }();
  return kAll;
}

}  // namespace hybray::procedural
