#include "core/scene/procedural/generators.h"

#include <array>

namespace hybray::procedural {

std::span<const Generator> generators() {
  static constexpr std::array<Generator, 3> kGenerators{{
      {"atrium", "two-storey colonnaded hall with arches, vaults, drapes and a gallery, 30 m long",
       uint32_t{1} << 18, atrium},
      {"sphere", "a sphere in a small walled court", uint32_t{1} << 10, sphere},
      {"street", "town street with facades, awnings, a square and many small objects, 90 m long",
       uint32_t{1} << 20, street},
  }};
  return kGenerators;
}

}  // namespace hybray::procedural
