// What the files of the atrium share: its plan, materials and the places where things repeat.
//
// The plan, seen from above: a nave inside a ring of columns (x = +-11.2, z = +-4.8, one every 3.2 m), an
// aisle around it, and outer walls (x = +-15, z = +-8.6). The gallery's floor lies on the lower arcade at y
// = 5.6, the roof on the upper one at y = 10.8; half of the nave is vaulted, its middle is open to the sky.
#pragma once

#include "core/scene/procedural/model.h"
#include "core/scene/procedural/shapes.h"

namespace hybray::procedural::atrium_parts {

constexpr double kBay = 3.2;
constexpr double kRingX = 3.5 * kBay, kRingZ = 1.5 * kBay;  // column axes
constexpr double kWallX = 15.0, kWallZ = 8.6;               // inner faces of the outer walls
constexpr double kGallery = 5.6, kRoof = 10.8;  // upper side of the gallery's floor, lower side of the roof
constexpr double kEdge = 0.36;                  // from the column axes to the gallery's inner edge
constexpr double kAisle = kWallZ - kRingZ;

struct Materials {
  uint32_t stone, pale_stone, plaster, marble_light, marble_dark, tile, wood, iron, brass, gold, terracotta,
      soil, leaf, water, glass, mirror, flame;
  std::array<uint32_t, 4> cloth;
};

// A stretch of the ring: its frame has x along the wall, y up and z toward the nave, with the origin on the
// floor below the columns' axes.
struct Place {
  dmat4 frame;
  uint64_t number;
};
const std::vector<Place>& bays();     // the middles of the 20 bays
const std::vector<Place>& columns();  // the 20 columns; corner columns take the frame of a long side

Materials make_materials(Model& model);

void add_shell(Model& model, const Materials& materials);    // floors, walls, roof
void add_arcades(Model& model, const Materials& materials);  // columns and arches of both storeys
void add_vaults(Model& model, const Materials& materials);   // over aisles and nave
void add_balustrade(Model& model, const Materials& materials);
void add_drapes(Model& model, const Materials& materials);
void add_ornaments(Model& model, const Materials& materials);  // lion heads, rosettes, mouldings of arches
void add_furniture(Model& model, const Materials& materials);  // fountain, pots, pedestals, lamps, benches

// All of the above with its materials, lanterns and cameras.
void add_hall(Model& model);

}  // namespace hybray::procedural::atrium_parts
