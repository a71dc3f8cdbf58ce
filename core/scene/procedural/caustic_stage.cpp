#include "core/scene/procedural/caustic_stage.h"

namespace hybray::procedural::caustic_stage {

Material clear_glass() {
  return {.name = "glass",
          .base_color = vec3(1.0f),
          .roughness = 0.0f,
          .transmission = 1.0f,
          .ior = 1.5f,
          .absorption = vec3(0.14f, 0.08f, 0.11f)};
}

Material clear_water() {
  return {.name = "water",
          .base_color = vec3(1.0f),
          .roughness = 0.0f,
          .transmission = 1.0f,
          .ior = 1.33f,
          .absorption = vec3(0.34f, 0.0565f, 0.00922f)};
}

Material polished_gold() {
  return {.name = "gold",
          .base_color = vec3(0.95f, 0.78f, 0.40f),
          .metallic = 1.0f,
          .roughness = 0.0f,
          .conductor_eta = vec3(0.21f, 0.43f, 1.38f),
          .conductor_k = vec3(3.272f, 2.455f, 1.914f)};
}

Material polished_silver() {
  return {.name = "silver",
          .base_color = vec3(0.98f, 0.98f, 0.97f),
          .metallic = 1.0f,
          .roughness = 0.0f,
          .conductor_eta = vec3(0.06f, 0.06f, 0.04f),
          .conductor_k = vec3(4.152f, 3.586f, 2.657f)};
}

Material front_mirror() {
  return {.name = "mirror", .base_color = vec3(0.95f), .metallic = 1.0f, .roughness = 0.0f};
}

Material matte(const std::string& name, const vec3& color) {
  return {.name = name, .base_color = color, .roughness = 1.0f};
}

void ground(MeshBuilder& part, const Lod& lod, const dvec3& corner, const dvec3& along, const dvec3& across,
            double share) {
  part.surface(1 + lod.filling(share), 1, {},
               [&](double u, double v) { return corner + u * along + v * across; });
}

void add_room(Model& model, const Room& room) {
  MeshBuilder floor = model.part(), wall = model.part();
  const double x = room.half_x, z = room.half_z;
  ground(floor, model.lod(key("floor")), {-x, 0, z}, {2.0 * x, 0, 0}, {0, 0, -2.0 * z});
  ground(wall, model.lod(key("wall")), {-x, 0, -z}, {2.0 * x, 0, 0}, {0, room.height, 0});
  model.add(std::move(floor), model.material(matte("floor", room.floor_color)), "floor");
  model.add(std::move(wall), model.material(matte("wall", room.wall_color)), "wall");
}

void add_ball(Model& model, uint32_t material, const std::string& name, const dvec3& center, double radius,
              double base) {
  const Lod lod = model.lod(key(name.c_str()));
  MeshBuilder part = model.part();
  ball(part, center, radius, lod.segments(base, 8), lod.segments(0.5 * base, 5));
  model.add(std::move(part), material, name);
}

void add_band(Model& model, uint32_t material, const std::string& name, const dvec3& center, double radius,
              double thickness, double height, double base) {
  const Lod lod = model.lod(key(name.c_str()));
  // Half circles join the two walls above and below; their ends are where the walls begin, to the last bit.
  const double bend = 0.5 * thickness;
  const int around = lod.segments(base, 12), turn = lod.segments(base / 16.0, 2);
  const int up = lod.segments(base / 24.0, 1);
  Curve2 profile;
  const auto half_circle = [&](double y, double from) {
    for (int i = 0; i <= turn; ++i) {
      const double a = from + kPi * i / turn;
      profile.emplace_back(radius + bend + bend * std::cos(a), y + bend * std::sin(a));
    }
  };
  const auto wall = [&](double from, double to) {
    const double r = profile.back().x;
    for (int i = 1; i < up; ++i) profile.emplace_back(r, from + (to - from) * i / up);
  };
  half_circle(height - bend, 0.0);
  wall(height - bend, bend);
  half_circle(bend, kPi);
  wall(bend, height - bend);
  MeshBuilder part = model.part();
  part.set_frame(moved(center));
  const int nv = static_cast<int>(profile.size());
  part.surface(around, nv, {.closed_u = true, .closed_v = true}, [&](double u, double v) {
    const dvec2 p = profile[static_cast<size_t>(std::lround(v * nv)) % profile.size()];
    const double a = 2.0 * kPi * u;
    return dvec3(p.x * std::cos(a), p.y, -p.x * std::sin(a));
  });
  model.add(std::move(part), material, name);
}

void add_bowl(Model& model, uint32_t material, const std::string& name, const dvec3& foot, double radius,
              double base) {
  const Lod lod = model.lod(key(name.c_str()));
  MeshBuilder part = model.part();
  part.set_frame(moved(foot) * glm::scale(dmat4(1.0), dvec3(radius)));
  lathe(part,
        smooth(Curve2{{0.0, 0.0},
                      {0.42, 0.02},
                      {0.74, 0.2},
                      {0.94, 0.48},
                      {1.0, 0.78},
                      {0.985, 0.8},
                      {0.96, 0.785},
                      {0.9, 0.5},
                      {0.71, 0.235},
                      {0.4, 0.06},
                      {0.0, 0.04}},
               lod.segments(0.5 * base, 10)),
        lod.segments(base, 8));
  model.add(std::move(part), material, name);
}

void add_vase(Model& model, uint32_t material, const std::string& name, const dvec3& foot, double height,
              double base) {
  const Lod lod = model.lod(key(name.c_str()));
  MeshBuilder part = model.part();
  part.set_frame(moved(foot) * glm::scale(dmat4(1.0), dvec3(height)));
  lathe(part,
        smooth(Curve2{{0.0, 0.0},
                      {0.17, 0.003},
                      {0.22, 0.03},
                      {0.27, 0.2},
                      {0.26, 0.45},
                      {0.17, 0.7},
                      {0.14, 0.84},
                      {0.19, 0.985},
                      {0.18, 1.0},
                      {0.165, 0.985},
                      {0.115, 0.84},
                      {0.145, 0.7},
                      {0.23, 0.44},
                      {0.235, 0.22},
                      {0.13, 0.12},
                      {0.0, 0.1}},
               lod.segments(0.6 * base, 15)),
        lod.segments(base, 8));
  model.add(std::move(part), material, name);
}

void add_lamp(Model& model, uint32_t shade_material, const Light& light, double shade_radius) {
  const Lod lod = model.lod(key(light.name.c_str()));
  MeshBuilder part = model.part();
  part.set_frame(moved(dvec3(light.position)) * glm::scale(dmat4(1.0), dvec3(shade_radius)));
  lathe(part, {{0.0, 0.5}, {0.9, 0.5}, {1.0, 0.55}, {0.3, 1.2}, {0.0, 1.25}}, lod.segments(16.0, 5));
  model.add(std::move(part), shade_material, light.name + "_shade");
  model.light(light);
}

}  // namespace hybray::procedural::caustic_stage
