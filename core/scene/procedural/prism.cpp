// A solid glass prism in a narrow beam: a patch of light bent onto the floor, whose place Snell's law gives.
#include "core/scene/procedural/caustic_stage.h"

namespace hybray::procedural {
namespace {

constexpr double kSide = 0.2, kLength = 0.36;  // of the equilateral triangle, and of the prism along z

// Its axis along z; the corners are given in the plane z = 0, counter-clockwise, and every face takes them as
// they are, so that edges are shared to the last bit.
void add_prism(Model& model, uint32_t material, const dvec3& at) {
  MeshBuilder part = model.part();
  part.set_frame(moved(at));
  const double height = 0.5 * std::sqrt(3.0) * kSide, z = 0.5 * kLength;
  const std::array<dvec2, 3> corners{{{-0.5 * kSide, 0.0}, {0.5 * kSide, 0.0}, {0.0, height}}};
  const auto corner = [&](int i, double side) {
    return dvec3(corners[static_cast<size_t>(i % 3)], side * z);
  };
  for (int i = 0; i < 3; ++i) part.quad(corner(i, -1), corner(i + 1, -1), corner(i + 1, 1), corner(i, 1));
  part.face(std::array<dvec3, 3>{corner(0, 1), corner(1, 1), corner(2, 1)});
  part.face(std::array<dvec3, 3>{corner(2, -1), corner(1, -1), corner(0, -1)});
  model.add(std::move(part), material, "prism");
}

// A rod with a saucer on top, on which the prism rests at each end.
void add_stand(Model& model, uint32_t material, const dvec3& top) {
  const Lod lod = model.lod(key("stand", top.z > 0.0 ? 1 : 0));
  MeshBuilder part = model.part();
  part.set_frame(moved({top.x, 0.0, top.z}));
  lathe(part,
        smooth(Curve2{{0.07, 0.0},
                      {0.068, 0.012},
                      {0.02, 0.025},
                      {0.012, 0.06},
                      {0.011, 0.5 * top.y},
                      {0.012, top.y - 0.04},
                      {0.03, top.y - 0.01},
                      {0.03, top.y - 0.002},
                      {0.0, top.y - 0.002}},
               lod.segments(40.0, 9)),
        lod.segments(40.0, 6));
  model.add(std::move(part), material, "stand");
}

// The housing of the spot light: a tube open toward the beam, behind whose mouth the light stands.
void add_housing(Model& model, uint32_t material, const dvec3& light, const dvec3& direction) {
  const Lod lod = model.lod(key("housing"));
  const dvec3 y = -direction, x = glm::normalize(glm::cross(y, dvec3(0, 0, 1))), z = glm::cross(x, y);
  MeshBuilder part = model.part();
  part.set_frame(dmat4(dvec4(x, 0), dvec4(y, 0), dvec4(z, 0), dvec4(light, 1)));
  lathe(part,
        smooth(Curve2{{0.0, 0.03},
                      {0.034, 0.03},
                      {0.036, -0.05},
                      {0.04, -0.06},
                      {0.044, -0.05},
                      {0.046, 0.1},
                      {0.03, 0.14},
                      {0.0, 0.15}},
               lod.segments(36.0, 14)),
        lod.segments(40.0, 8));
  model.add(std::move(part), material, "housing");
}

void layout(Model& model) {
  using namespace caustic_stage;
  add_room(model, {1.4, 0.9, 1.1});
  const uint32_t dark = model.material(matte("dark_metal", vec3(0.08f, 0.08f, 0.09f)));
  const double y = 0.45;
  add_prism(model, model.material(clear_glass()), {0.0, y, 0.0});
  for (const double z : {-0.12, 0.12}) add_stand(model, dark, {0.0, y, z});
  // The beam rises by 8 degrees and meets the left face at 38 from its normal; it leaves the right one at 61,
  // falling by 31 (at less than 28 degrees it would be reflected there, totally).
  const dvec3 spot(-0.9, 0.415, 0.1), aim(-0.05, y + 0.085, 0.0);
  const dvec3 direction = glm::normalize(aim - spot);
  add_housing(model, dark, spot, direction);
  model.light({.name = "beam",
               .kind = LightKind::spot,
               .position = vec3(spot),
               .direction = vec3(direction),
               .intensity = 25.0f,
               .inner_cone_angle = 0.03f,
               .outer_cone_angle = 0.05f});
  model.light({.name = "fill", .position = vec3(0.6f, 1.3f, 1.2f), .intensity = 0.5f});
  model.camera("front", {0.25f, 0.75f, 1.75f}, {0.1f, 0.35f, 0.0f}, 45.0f);
  model.camera("patch", {1.2f, 0.6f, 0.85f}, {0.45f, 0.08f, -0.1f}, 45.0f);
  model.camera("wall", {-0.4f, 0.7f, 1.1f}, {0.15f, 0.42f, -0.6f}, 55.0f);
}

}  // namespace

Scene prism(const Parameters& parameters) {
  return build("prism", parameters, uint32_t{1} << 13, layout);
}

}  // namespace hybray::procedural
