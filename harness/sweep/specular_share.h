// How much of its lights' surroundings a scene's specular surfaces take up, for estimates of cost.
#pragma once

#include "core/scene/scene.h"

namespace hybray {

// Texels of caustic maps that see a specular surface, in maps of all lights, over the texels of the six
// frames of one full map. Estimated from the surfaces that face a light, each at its solid angle; what stands
// before them is not looked for, so it comes out too large where much is hidden.
double specular_share(const Scene& scene);

}  // namespace hybray
