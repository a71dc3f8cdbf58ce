// A light of each kind over the mixed scene, for tests of emission.
#pragma once

#include "core/caustics/emission.h"
#include "tests/core/caustics/caustic_scenes.h"

#include <vector>

namespace hybray::test {

using namespace caustics;

constexpr EmissionKind kEmissionKinds[] = {EmissionKind::map, EmissionKind::uniform, EmissionKind::mixture};

// The mixed scene under one light of each kind, with its map.
struct Lit {
  explicit Lit(const Light& light, int resolution = 24)
      : prepared([&] {
          Scene scene = mixed_scene();
          scene.lights = {light};
          update_content_hash(scene);
          return scene;
        }()),
        map(make_visibility_map(prepared.tracer, prepared.caustic.optics, prepared.caustic.targets, 0,
                                resolution)) {}

  const Light& light() const { return prepared.scene.lights[0]; }
  Emission emission(EmissionKind kind, double expected, uint64_t seed = 1) const {
    return {light(), map, prepared.scene.bounds, kind, expected, seed};
  }

  Prepared prepared;
  VisibilityMap map;
};

inline Light lamp(LightKind kind, float outer = 0.6f) {
  Light light = point_light(vec3(0.3f, 3.0f, 0.4f), 10.0f, vec3(1.0f, 0.8f, 0.5f));
  light.kind = kind;
  light.direction = glm::normalize(vec3(0.1f, -1.0f, -0.1f));
  light.inner_cone_angle = 0.2f, light.outer_cone_angle = outer;
  return light;
}

inline std::vector<Light> lamps() {
  return {lamp(LightKind::point), lamp(LightKind::spot), lamp(LightKind::spot, 1.1f),
          lamp(LightKind::directional)};
}

}  // namespace hybray::test
