// Generators of scenes whose form is exact: they have no level of detail.
#pragma once

#include "core/base/error.h"
#include "core/scene/procedural/generators.h"

#include <fmt/format.h>

namespace hybray::procedural {

// A generator of what `make` makes. Throws InputError where another number of triangles is wanted.
template <Scene (*make)()>
Scene exact(const Parameters& parameters) {
  Scene scene = make();
  if (parameters.triangles != 0 && parameters.triangles != scene.triangle_count())
    throw InputError("generator " + scene.name,
                     fmt::format("cannot make {} triangles; its form is exact and has {}",
                                 parameters.triangles, scene.triangle_count()));
  update_content_hash(scene);
  return scene;
}

}  // namespace hybray::procedural
