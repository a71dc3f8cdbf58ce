// A floor before a wall, with a few blocks on it: large flat faces only, on which a march has nothing to be
// wrong about but its own numbers.
#pragma once

#include "core/scene/scene.h"

namespace hybray::procedural {

Scene corner();

}  // namespace hybray::procedural
