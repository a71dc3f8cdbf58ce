// What the caustics of the closed-form scenes (core/scene/procedural/closed_form_scenes.h) must be: mean
// irradiance over regions of the receiver, by formula or by quadrature over the paths' parameters. Nothing of
// this is shared with the code that it judges: Fresnel, Snell and all geometry are written again, in double.
#pragma once

#include "core/scene/procedural/closed_form_scenes.h"
#include "core/scene/scene.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hybray::truth {

struct Region {
  std::string name;
  std::function<bool(const dvec3&)> contains;  // of a point on the receiver
  double area = 0.0;                           // m^2
  double irradiance = 0.0;                     // mean over the region, W/m^2, of light with a specular event
  double quadrature_error = 0.0;               // of the irradiance, W/m^2; 0 where a formula gives it
};

struct ClosedForm {
  std::string scene;
  uint32_t receiver_primitives = 0;  // the scene's first so many primitives receive
  std::vector<Region> regions;       // may overlap
  int specular_events_needed = 1;    // with fewer, nothing arrives
  int max_specular_events = 0;       // that were followed

  bool receives(uint32_t primitive) const { return primitive < receiver_primitives; }
};

// The truth for `scene` when each path follows at most `max_specular_events` reflections and refractions (all
// that matter, for a large number). Valid for any number; nothing where fewer than specular_events_needed are
// followed, and where the scene is none of the closed-form scenes, unchanged but for its cameras.
std::optional<ClosedForm> closed_form(const Scene& scene, int max_specular_events);

// The same for the scene that procedural::closed_form_scene makes of these numbers. Any index of refraction
// above 1; a slab of any thickness; incidence below a right angle.
std::optional<ClosedForm> closed_form(const procedural::BallLens& c, int max_specular_events);
std::optional<ClosedForm> closed_form(const procedural::GlassSlab& c, int max_specular_events);
std::optional<ClosedForm> closed_form(const procedural::FlatWater& c, int max_specular_events);
std::optional<ClosedForm> closed_form(const procedural::Furnace& c, int max_specular_events);
std::optional<ClosedForm> closed_form(const procedural::SunlitPool& c, int max_specular_events);
std::optional<ClosedForm> closed_form(const procedural::GrazedReceiver& c, int max_specular_events);

}  // namespace hybray::truth
