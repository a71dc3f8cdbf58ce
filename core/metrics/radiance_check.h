// What an image must be before an error is computed from it: otherwise the comparison fails, and no average
// hides it.
#pragma once

#include "core/base/image2d.h"
#include "core/base/vec.h"

#include <string>

namespace hybray::metrics {

// Throws InputError, with `name` and the first offending pixel, unless the image has pixels and every channel
// is finite and not negative.
void require_radiance(const Image2D<vec3>& image, const std::string& name);

// Throws InputError unless `image` has the size width x height of what `other` names.
void require_size(const Image2D<vec3>& image, const std::string& name, int width, int height,
                  const std::string& other);

}  // namespace hybray::metrics
