#include "core/truth/closed_forms.h"

#include "core/scene/procedural/closed_form_scenes.h"
#include "core/truth/closed_form_cases.h"

#include <array>
#include <string_view>

namespace hybray::truth {
namespace {

// What a scene of a generator must be, and how many events its light needs at least.
struct Case {
  std::string_view scene;
  int events_needed;
  std::vector<Region> (*regions)(int max_events);
};

template <class Numbers>
std::vector<Region> standard(int max_events) {
  return regions_of(Numbers{}, max_events);
}

constexpr int kLens = 2, kSlab = 2, kWater = 1, kFurnace = 1, kBeam = 1;

constexpr std::array<Case, 10> kCases{{
    {"closed_ball_lens", kLens, standard<procedural::BallLens>},
    {"closed_cardioid", 1, cardioid_regions},
    {"closed_cylinder", 1, cylinder_regions},
    {"closed_flat_water", kWater, standard<procedural::FlatWater>},
    {"closed_furnace", kFurnace, standard<procedural::Furnace>},
    {"closed_glass_slab", kSlab, standard<procedural::GlassSlab>},
    {"closed_paraboloid", 1, paraboloid_regions},
    {"closed_plane_mirror", 1, plane_mirror_regions},
    {"closed_prism", 2, prism_regions},
    {"closed_tir_prism", 3, tir_prism_regions},
}};

std::optional<ClosedForm> form_of(const Scene& scene, int events_needed, int max_events,
                                  const std::function<std::vector<Region>(int)>& regions) {
  if (max_events < events_needed) return std::nullopt;
  ClosedForm form;
  form.scene = scene.name;
  for (const SceneObject& object : scene.objects)
    if (object.name == "receiver") form.receiver_primitives += object.triangle_count;
  form.specular_events_needed = events_needed;
  form.max_specular_events = max_events;
  form.regions = regions(max_events);
  return form;
}

template <class Numbers>
std::optional<ClosedForm> form_of(const Numbers& c, int events_needed, int max_events) {
  return form_of(procedural::closed_form_scene(c), events_needed, max_events,
                 [&](int events) { return regions_of(c, events); });
}

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
    auto form = form_of(scene, c.events_needed, max_specular_events, c.regions);
    if (form) form->scene = generator->name;
    return form;
  }
  return std::nullopt;
}

std::optional<ClosedForm> closed_form(const procedural::BallLens& c, int max_events) {
  return form_of(c, kLens, max_events);
}
std::optional<ClosedForm> closed_form(const procedural::GlassSlab& c, int max_events) {
  return form_of(c, kSlab, max_events);
}
std::optional<ClosedForm> closed_form(const procedural::FlatWater& c, int max_events) {
  return form_of(c, kWater, max_events);
}
std::optional<ClosedForm> closed_form(const procedural::Furnace& c, int max_events) {
  return form_of(c, kFurnace, max_events);
}
std::optional<ClosedForm> closed_form(const procedural::SunlitPool& c, int max_events) {
  return form_of(c, kBeam, max_events);
}
std::optional<ClosedForm> closed_form(const procedural::GrazedReceiver& c, int max_events) {
  return form_of(c, kBeam, max_events);
}

}  // namespace hybray::truth
