// The closed forms themselves, one a scene: the regions of the receiver with their irradiance for paths of at
// most `max_events` specular events. closed_forms.cpp looks them up.
#pragma once

#include "core/scene/procedural/closed_form_scenes.h"
#include "core/truth/closed_forms.h"

#include <vector>

namespace hybray::truth {

// Axially symmetric: closed_form_axial.cpp.
std::vector<Region> regions_of(const procedural::BallLens& c, int max_events);
std::vector<Region> regions_of(const procedural::GlassSlab& c, int max_events);
std::vector<Region> regions_of(const procedural::FlatWater& c, int max_events);
std::vector<Region> regions_of(const procedural::Furnace& c, int max_events);

// closed_form_mirrors.cpp
std::vector<Region> plane_mirror_regions(int max_events);
std::vector<Region> paraboloid_regions(int max_events);

// One beam of parallel light: closed_form_beams.cpp.
std::vector<Region> regions_of(const procedural::SunlitPool& c, int max_events);
std::vector<Region> regions_of(const procedural::GrazedReceiver& c, int max_events);

// Upright cylinders, seen from above: closed_form_cylinder.cpp.
std::vector<Region> cylinder_regions(int max_events);
std::vector<Region> cardioid_regions(int max_events);

// Prisms in their cross section: closed_form_prism.cpp.
std::vector<Region> prism_regions(int max_events);
std::vector<Region> tir_prism_regions(int max_events);

}  // namespace hybray::truth
