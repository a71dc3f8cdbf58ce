// A named pinhole camera.
#pragma once

#include "core/base/vec.h"

#include <string>

namespace hybray {

struct Camera {
  std::string name;
  vec3 eye{0.0f};                  // metres
  vec3 target{0.0f, 0.0f, -1.0f};  // any point on the view axis, other than the eye
  vec3 up{0.0f, 1.0f, 0.0f};       // not parallel to the view axis
  float vertical_fov = 60.0f;      // degrees, in (0, 180)
};

}  // namespace hybray
