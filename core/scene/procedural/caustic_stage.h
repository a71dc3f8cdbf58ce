// What the scenes made for caustics share: matte ground, clear and polished materials with measured indices,
// and things of glass and metal to stand about. Grounds are matte throughout (roughness 1), so that whatever
// is bright on them was brought there by light.
#pragma once

#include "core/scene/procedural/model.h"
#include "core/scene/procedural/shapes.h"

namespace hybray::procedural::caustic_stage {

// Crown glass, n = 1.5, very slightly green: 1 m of it lets through nine tenths.
Material clear_glass();
// Water, n = 1.33, with the absorption of pure water at 650, 550 and 450 nm (Pope and Fry 1997).
Material clear_water();
// Metals by their complex index at 617, 549 and 451 nm (Johnson and Christy 1972).
Material polished_gold();
Material polished_silver();
// A front-surface mirror that reflects 95 % at every angle.
Material front_mirror();
Material matte(const std::string& name, const vec3& color);

// A flat rectangle `corner` + u `along` + v `across`, front at along x across, in strips across its length.
// Strips take up the triangles that the curved shapes leave over; `share` is their number at level 1.
void ground(MeshBuilder& part, const Lod& lod, const dvec3& corner, const dvec3& along, const dvec3& across,
            double share = 4.0);

// A floor of 2 `half_x` by 2 `half_z` about the origin and a wall behind it (-z), `height` high.
struct Room {
  double half_x, half_z, height;
  vec3 floor_color{0.7f}, wall_color{0.6f, 0.58f, 0.55f};
};
void add_room(Model& model, const Room& room);

// A ball about `center`, with `base` segments around at level 1.
void add_ball(Model& model, uint32_t material, const std::string& name, const dvec3& center, double radius,
              double base);

// A polished ring that lies on y = `center.y`: `height` high, `thickness` thick, inner wall at `radius`.
void add_band(Model& model, uint32_t material, const std::string& name, const dvec3& center, double radius,
              double thickness, double height, double base);

// An open bowl of a wall 4 % of its radius thick, standing on `foot`.
void add_bowl(Model& model, uint32_t material, const std::string& name, const dvec3& foot, double radius,
              double base);

// A vase with a thick foot and a hollow body, `height` high, standing on `foot`.
void add_vase(Model& model, uint32_t material, const std::string& name, const dvec3& foot, double height,
              double base);

// A lamp: the light at `position`, and above it a shade that keeps its housing out of the light's way.
void add_lamp(Model& model, uint32_t shade_material, const Light& light, double shade_radius);

}  // namespace hybray::procedural::caustic_stage
