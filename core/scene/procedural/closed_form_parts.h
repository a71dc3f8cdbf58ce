// What the closed-form scenes are made of.
#pragma once

#include "core/scene/procedural/closed_form_scenes.h"
#include "core/scene/procedural/mesh_builder.h"

namespace hybray::procedural {

uint32_t add_material(Scene& scene, const Material& material);
uint32_t add_clear(Scene& scene, const char* name, double ior, double absorption = 0.0);
uint32_t add_mirror(Scene& scene);
uint32_t add_receiver_material(Scene& scene);

void add_part(Scene& scene, MeshBuilder& part, uint32_t material, const char* name);

// The parallelogram with corner `a` and edges u and v; its front is the side of u x v.
void add_parallelogram(Scene& scene, const dvec3& a, const dvec3& u, const dvec3& v, uint32_t material,
                       const char* name);

// The walls of a room about the origin, whose fronts face inward.
void add_room(Scene& scene, double half_size, uint32_t material, const char* name);

// A scene with a floor, which is its first object.
Scene with_floor(const char* name, double half_width);

void add_lamp(Scene& scene, const dvec3& position);
void add_sun(Scene& scene, const dvec3& direction);
void add_camera(Scene& scene, const dvec3& eye, const dvec3& target, float vertical_fov);

}  // namespace hybray::procedural
