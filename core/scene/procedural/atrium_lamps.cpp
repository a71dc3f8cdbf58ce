// The atrium by night, lit by 16 lamps that each stand by a thing of glass and one of metal: eight in view of
// the camera "nave", and eight out of it, behind the camera or up on the gallery. After the setting in which
// the cost of a light that is seen and of one that is not were first told apart.
#include "core/scene/procedural/atrium.h"
#include "core/scene/procedural/caustic_stage.h"

#include <algorithm>
#include <string>

namespace hybray::procedural {
namespace {

struct Station {
  double x, floor, z;
};

// In the order in which a sweep over the number of lamps takes them.
constexpr std::array<Station, 8> kVisible{{{-3.5, 0, -1.5},
                                           {2.9, 0, 1.7},
                                           {-6.5, 0, -0.6},
                                           {3.3, 0, -2.5},
                                           {-3.3, 0, 1.4},
                                           {7.4, 0, 0.9},
                                           {-2.4, 0, -3.1},
                                           {8.6, 0, 3.3}}};
constexpr double kUp = atrium_parts::kGallery;
constexpr std::array<Station, 8> kHidden{{{-13.0, 0, 0.2},
                                          {0.0, kUp, -7.2},
                                          {3.2, kUp, 7.2},
                                          {-13.0, 0, 3.2},
                                          {-3.2, kUp, 7.2},
                                          {6.4, kUp, -7.2},
                                          {-13.0, 0, -3.2},
                                          {-6.4, kUp, -7.2}}};

struct Materials {
  uint32_t glass, gold, silver, stone, iron;
};

// A plinth with a glass ball or vase, a ring or bowl of metal on the floor, and the lamp on its post.
void add_station(Model& model, const Materials& m, const Station& station, const std::string& name,
                 size_t number) {
  const dvec3 foot(station.x, station.floor, station.z), glass = foot + dvec3(0.3, 0, -0.1);
  const dvec3 metal = foot + dvec3(-0.28, 0.001, 0.22);
  constexpr double kPlinth = 0.26, kHeight = 1.25;
  MeshBuilder plinth = model.part();
  plinth.bevelled_box({-0.12, -0.02, -0.12}, {0.12, kPlinth, 0.12}, 0.015);
  model.add(std::move(plinth), m.stone, name + "_plinth", moved(glass));
  const dvec3 top = glass + dvec3(0, kPlinth + 0.0005, 0);
  if (number % 2 == 0)
    caustic_stage::add_ball(model, m.glass, name + "_ball", top + dvec3(0, 0.2, 0), 0.2, 116.0);
  else
    caustic_stage::add_vase(model, m.glass, name + "_vase", top, 0.45, 96.0);
  if (number % 4 < 2)
    caustic_stage::add_band(model, m.gold, name + "_ring", metal, 0.16, 0.012, 0.08, 160.0);
  else
    caustic_stage::add_bowl(model, m.silver, name + "_bowl", metal, 0.16, 104.0);

  const dvec3 lamp = foot + dvec3(-0.25, kHeight, -0.35), post = lamp + dvec3(-0.05, 0, -0.2);
  const Lod lod = model.lod(key((name + "_post").c_str()));
  MeshBuilder iron = model.part();
  const int sides = lod.segments(8.0, 3);
  tube(iron, {{post.x, foot.y - 0.02, post.z}, {post.x, post.y + 0.12, post.z}}, 0.012, sides);
  tube(iron, {{post.x, post.y + 0.11, post.z}, lamp + dvec3(0, 0.11, 0)}, 0.01, sides);
  model.add(std::move(iron), m.iron, name + "_post");
  caustic_stage::add_lamp(
      model, m.iron,
      {.name = name, .position = vec3(lamp), .color = vec3(1.0f, 0.82f, 0.6f), .intensity = 4.0f}, 0.1);
}

void layout(Model& model) {
  atrium_parts::add_hall(model);
  const Materials m{model.material(caustic_stage::clear_glass()),
                    model.material(caustic_stage::polished_gold()),
                    model.material(caustic_stage::polished_silver()),
                    model.material(caustic_stage::matte("plinth", {0.5f, 0.47f, 0.42f})),
                    model.material(caustic_stage::matte("post", {0.05f, 0.05f, 0.05f}))};
  for (size_t i = 0; i < kVisible.size(); ++i)
    add_station(model, m, kVisible[i], "visible_" + std::to_string(i), i);
  for (size_t i = 0; i < kHidden.size(); ++i)
    add_station(model, m, kHidden[i], "hidden_" + std::to_string(i), i);
}

}  // namespace

Scene atrium_lamps(const Parameters& parameters) {
  Scene scene = build("atrium_lamps", parameters, uint32_t{3} << 17, layout);
  // The hall's own lanterns are out: only what is swept over shines.
  std::erase_if(scene.lights, [](const Light& light) {
    return !light.name.starts_with("visible_") && !light.name.starts_with("hidden_");
  });
  update_content_hash(scene);
  return scene;
}

}  // namespace hybray::procedural
