#include "core/truth/closed_forms.h"

#include "core/scene/procedural/closed_form_scenes.h"
#include "core/truth/closed_form_cases.h"

#include <array>
#include <string_view>

namespace hybray::truth {
namespace {

struct Case {
  std::string_view scene;
  int events_needed;
  std::vector<Region> (*regions)(int max_events);
};

constexpr std::array<Case, 10> kCases{{
    {"closed_ball_lens", 2, ball_lens_regions},
    {"closed_cardioid", 1, cardioid_regions},
    {"closed_cylinder", 1, cylinder_regions},
    {"closed_flat_water", 1, flat_water_regions},
    {"closed_furnace", 1, furnace_regions},
    {"closed_glass_slab", 2, glass_slab_regions},
    {"closed_paraboloid", 1, paraboloid_regions},
    {"closed_plane_mirror", 1, plane_mirror_regions},
    {"closed_prism", 2, prism_regions},
    {"closed_tir_prism", 3, tir_prism_regions},
}};

// The closed-form scene that `scene` is, whatever its name and cameras.
const procedural::Generator* generator_of(const Scene& scene) {
  for (const procedural::Generator& generator : procedural::closed_form_generators()) {
    Scene exact = generator.generate({});
    exact.cameras = scene.cameras;
    update_content_hash(exact);
    if (exact.content_hash == scene.content_hash) return &generator;
  }
  return nullptr;
}

}  // namespace

std::optional<ClosedForm> closed_form(const Scene& scene, int max_specular_events) {
  const procedural::Generator* generator = generator_of(scene);
  if (!generator) return std::nullopt;
  for (const Case& c : kCases) {
    if (c.scene != generator->name) continue;
    if (max_specular_events < c.events_needed) return std::nullopt;
    ClosedForm form;
    form.scene = generator->name;
    for (const SceneObject& object : scene.objects)
      if (object.name == "receiver") form.receiver_primitives += object.triangle_count;
    form.specular_events_needed = c.events_needed;
    form.max_specular_events = max_specular_events;
    form.regions = c.regions(max_specular_events);
    return form;
  }
  return std::nullopt;
}

}  // namespace hybray::truth
