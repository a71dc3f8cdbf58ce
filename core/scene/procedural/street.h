// What the files of the street share: its plan, materials, and the things that stand in several places.
//
// The public space is one closed polygon whose every edge is the front of a house: a street of about 90 m
// that bends in its middle, where a square opens to the north. The carriageway lies at y = 0, the pavements
// and the square at kPavement.
#pragma once

#include "core/scene/procedural/model.h"
#include "core/scene/procedural/shapes.h"

#include <array>

namespace hybray::procedural::street_parts {

constexpr double kPavement = 0.12;

struct Materials {
  std::array<uint32_t, 6> plaster;
  std::array<uint32_t, 4> shutter, fabric, paint;
  uint32_t stone, dark_stone, asphalt, kerb, slate, zinc, white_wood, wood, iron, steel, chrome, brass, pane,
      lit_pane, glass, wine, ceramic, rubber, leaf, dark_leaf, flower, bark, terracotta, soil, canvas, bulb,
      sheet;
};
Materials make_materials(Model& model);

// The front of a house: its frame has x along the wall from 0 to `length`, y up, and z toward the public
// space.
struct Front {
  dmat4 frame;
  double length;
  uint64_t number;
};

struct House {
  Front front;
  double height;        // of its cornice
  double ground_floor;  // height of the ground floor
  int storeys;          // above the ground floor
};

std::vector<House> make_houses(const Model& model);

void add_ground(Model& model, const Materials& materials);
void add_roofs(Model& model, const Materials& materials, const std::vector<House>& houses);
void add_facade(Model& model, const Materials& materials, const House& house);
void add_furniture(Model& model, const Materials& materials);  // lamps, cables, bollards, benches, pots
void add_cafes(Model& model, const Materials& materials);      // tables, chairs, parasols
void add_vehicles(Model& model, const Materials& materials);   // bicycles and cars
void add_trees(Model& model, const Materials& materials);

// The parts of one facade, by material.
struct FacadeParts {
  explicit FacadeParts(const Model& model);
  MeshBuilder wall, trim, sash, pane, lit_pane, shutter, iron, fabric, fabric_2, leaf, flower, pot;
};

// Things on a facade, at `at`: the middle of their lower edge on the wall.
void add_window(FacadeParts& parts, const Lod& lod, const dmat4& at, double width, double height, bool lit);
void add_shutters(FacadeParts& parts, const Lod& lod, const dmat4& at, double width, double height);
void add_balcony(FacadeParts& parts, const Lod& lod, const dmat4& at, double width);
void add_flower_box(FacadeParts& parts, const Model& model, const Lod& lod, const dmat4& at, double width,
                    uint64_t key);
void add_awning(FacadeParts& parts, const Lod& lod, const dmat4& at, double width);
void add_door(FacadeParts& parts, const Lod& lod, const dmat4& at, double width, double height);

// `count` leaves that stand out from a ball of `radius`, mostly upward for `upward` near 1.
void add_bush(MeshBuilder& part, const Model& model, const Lod& lod, const dmat4& at, double radius,
              int count, double leaf_length, double upward, uint64_t key);

}  // namespace hybray::procedural::street_parts
