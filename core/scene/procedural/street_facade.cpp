// One facade: its wall with openings, what fills them, cornices and string courses, and the shop or door on
// the ground floor.
#include "core/scene/procedural/street.h"

namespace hybray::procedural::street_parts {

FacadeParts::FacadeParts(const Model& model)
    : wall(model.part()),
      trim(wall),
      sash(wall),
      pane(wall),
      lit_pane(wall),
      shutter(wall),
      iron(wall),
      fabric(wall),
      fabric_2(wall),
      leaf(wall),
      flower(wall),
      pot(wall) {}

namespace {

constexpr double kWindow = 1.06;  // width

enum class Dressing { plain, shutters, balconies, boxes };

struct Style {
  Dressing dressing;
  int bays;
  double margin, storey;
  bool shop, awning, pediments;
};

Style make_style(const Model& model, const House& house) {
  Dice dice = model.dice(key("style", house.front.number));
  Style style{};
  const int roll = dice.pick(8);
  style.dressing = roll < 3   ? Dressing::shutters
                   : roll < 6 ? Dressing::balconies
                   : roll < 7 ? Dressing::boxes
                              : Dressing::plain;
  style.margin = 0.45;
  style.bays = std::max(2, static_cast<int>((house.front.length - 2.0 * style.margin) / 2.25));
  style.storey = (house.height - 0.35 - house.ground_floor) / house.storeys;
  style.shop = dice(0.0, 1.0) < 0.65;
  style.awning = dice(0.0, 1.0) < 0.75;
  style.pediments = dice(0.0, 1.0) < 0.5;
  return style;
}

// A window of an upper floor, with its dressing.
void dress_window(FacadeParts& parts, const Model& model, const Style& style, double x, double y,
                  double height, uint64_t number) {
  const Lod lod = model.lod(key("window", number));
  Dice dice = model.dice(key("window", number));
  const dmat4 at = moved({x, y, 0});
  add_window(parts, lod, at, kWindow, height, dice(0.0, 1.0) < 0.12);
  if (style.dressing == Dressing::shutters) add_shutters(parts, lod, at, kWindow, height);
  if (style.dressing == Dressing::balconies) add_balcony(parts, lod, at, kWindow + 0.7);
  if (style.dressing == Dressing::boxes || dice(0.0, 1.0) < 0.25)
    add_flower_box(parts, model, lod,
                   style.dressing == Dressing::balconies ? at * moved({0, 0.75, 0.54}) : at, kWindow, number);
  if (style.pediments && lod.wants(0.25)) {
    parts.trim.set_frame(at * moved({0, height + 0.12, 0}));
    moulding(parts.trim, {{-0.03, 0.0}, {0.05, 0.02}, {0.1, 0.08}, {0.18, 0.12}, {0.18, 0.17}, {-0.03, 0.19}},
             -0.5 * kWindow - 0.2, 0.5 * kWindow + 0.2);
  }
}

// A shop: a wide pane on a plinth, with a door beside it, a sign above and perhaps an awning.
void add_shop(FacadeParts& parts, const Model& model, const House& house, const Style& style) {
  const Lod lod = model.lod(key("shop", house.front.number));
  const double length = house.front.length, left = 0.7, right = length - 2.2, top = 2.75;
  const int panes = 3;
  for (int i = 0; i < panes; ++i) {
    const double width = (right - left) / panes;
    add_window(parts, lod, moved({left + (i + 0.5) * width, kPavement + 0.55, 0}), width - 0.14,
               top - 0.55 - kPavement, i == 1);
  }
  add_door(parts, lod, moved({length - 1.35, kPavement, 0}), 1.05, 2.55);
  if (lod.wants(0.15)) {
    parts.shutter.set_frame(dmat4(1.0));
    parts.shutter.bevelled_box({left - 0.2, top + 0.2, -0.03}, {length - 0.6, top + 0.68, 0.08}, 0.02);
    parts.shutter.bevelled_box({left - 0.1, kPavement - 0.02, -0.03}, {right + 0.05, kPavement + 0.42, 0.07},
                               0.02);
    parts.trim.set_frame(moved({0, top + 0.66, 0}));
    moulding(parts.trim, {{-0.03, 0.0}, {0.1, 0.03}, {0.16, 0.1}, {-0.03, 0.15}}, left - 0.3, length - 0.5);
  }
  if (style.awning)
    add_awning(parts, lod, moved({0.5 * (left + right), top + 0.1, 0.02}), right - left + 0.3);
}

void add_cornices(FacadeParts& parts, const Model& model, const House& house) {
  const Lod lod = model.lod(key("cornice", house.front.number));
  const double x0 = 0.03, x1 = house.front.length - 0.03;
  if (!lod.wants(0.05)) return;
  parts.trim.set_frame(moved({0, house.height - 0.32, 0}));
  moulding(parts.trim,
           smooth(Curve2{{-0.04, -0.1},
                         {0.06, 0.0},
                         {0.08, 0.1},
                         {0.22, 0.18},
                         {0.36, 0.24},
                         {0.38, 0.36},
                         {0.3, 0.42},
                         {-0.1, 0.45}},
                  lod.segments(16, 7)),
           x0, x1, true);
  if (!lod.wants(0.12)) return;
  parts.trim.set_frame(moved({0, house.ground_floor - 0.08, 0}));
  moulding(parts.trim, {{-0.04, -0.08}, {0.06, -0.03}, {0.14, 0.04}, {0.14, 0.11}, {-0.04, 0.14}}, x0, x1);
  parts.trim.set_frame(dmat4(1.0));
  const int blocks = static_cast<int>((x1 - x0) / 0.42);
  for (int i = 0; i < blocks && lod.wants(0.35); ++i) {  // consoles below the cornice
    const double x = x0 + (i + 0.5) * (x1 - x0) / blocks;
    parts.trim.bevelled_box({x - 0.07, house.height - 0.36, -0.03}, {x + 0.07, house.height - 0.15, 0.2},
                            0.015);
  }
  for (int i = 0; i < 12 && lod.wants(0.3); ++i)  // quoins up both corners
    for (const bool right : {false, true}) {
      const double width = i % 2 ? 0.28 : 0.4,
                   y = house.ground_floor + 0.12 + i * (house.height - house.ground_floor - 0.7) / 12;
      const double a = right ? x1 - width : x0, b = right ? x1 : x0 + width;
      parts.trim.bevelled_box({a, y, -0.03}, {b, y + 0.3, 0.035}, 0.012);
    }
}

// A rain pipe at the right end of the facade.
void add_pipe(Model& model, const Materials& m, const House& house) {
  const Lod lod = model.lod(key("pipe", house.front.number));
  if (!lod.wants(0.15)) return;
  MeshBuilder part = model.part();
  const double x = house.front.length - 0.16, top = house.height - 0.5;
  tube(part, {{x, kPavement - 0.02, 0.1}, {x, top, 0.1}}, 0.05, lod.segments(12, 5));
  for (double y = 1.2; y < top && lod.wants(0.4); y += 2.1)
    ring(part, {x, y, 0.1}, {1, 0, 0}, {0, 0, 1}, 0.052, 0.012, lod.segments(14, 6), lod.segments(6, 3));
  model.add(std::move(part), m.zinc, "rain_pipe", house.front.frame);
}

}  // namespace

void add_facade(Model& model, const Materials& m, const House& house) {
  const Style style = make_style(model, house);
  const double length = house.front.length, bay = (length - 2.0 * style.margin) / style.bays;
  FacadeParts parts(model);
  std::vector<Opening> openings;
  const bool tall = style.dressing == Dressing::balconies;
  const double sill = tall ? 0.3 : 0.85, height = tall ? 2.15 : 1.6;
  // Openings are cut once the level affords them; the wall is one quad before.
  const Lod cut = model.lod(key("openings", house.front.number));
  const bool open = cut.wants(0.045);
  for (int storey = 0; storey < house.storeys && open; ++storey)
    for (int i = 0; i < style.bays; ++i) {
      const double x = style.margin + (i + 0.5) * bay, y = house.ground_floor + storey * style.storey + sill;
      openings.push_back({x - 0.5 * kWindow, x + 0.5 * kWindow, y, y + height});
      dress_window(parts, model, style, x, y, height,
                   house.front.number * 1000 + static_cast<uint64_t>(storey * 100 + i));
    }
  if (open && style.shop) {
    const double left = 0.7, width = (length - 2.9) / 3;
    for (int i = 0; i < 3; ++i)
      openings.push_back({left + i * width + 0.07, left + (i + 1) * width - 0.07, kPavement + 0.55, 2.75});
    openings.push_back({length - 1.35 - 0.525, length - 1.35 + 0.525, kPavement, kPavement + 2.55});
    add_shop(parts, model, house, style);
  } else if (open) {
    for (int i = 0; i < style.bays; ++i) {
      const Lod lod = model.lod(key("ground_window", house.front.number * 100 + static_cast<uint64_t>(i)));
      const double x = style.margin + (i + 0.5) * bay;
      if (i == style.bays / 2) {
        openings.push_back({x - 0.6, x + 0.6, kPavement, kPavement + 2.6});
        add_door(parts, lod, moved({x, kPavement, 0}), 1.2, 2.6);
      } else {
        openings.push_back({x - 0.5 * kWindow, x + 0.5 * kWindow, 1.05, 2.75});
        add_window(parts, lod, moved({x, 1.05, 0}), kWindow, 1.7, false);
        add_shutters(parts, lod, moved({x, 1.05, 0}), kWindow, 1.7);
      }
    }
  }
  parts.wall.set_frame(dmat4(1.0));
  wall_with_openings(parts.wall, 0, length, 0.0, house.height, openings);
  add_cornices(parts, model, house);
  add_pipe(model, m, house);

  const uint64_t i = house.front.number;
  Dice dice = model.dice(key("colors", i));
  const auto pick = [&](const auto& choices) {
    return choices[static_cast<size_t>(dice.pick(static_cast<int>(choices.size())))];
  };
  const dmat4& frame = house.front.frame;
  model.add(std::move(parts.wall), m.plaster[i % 6], "facade", frame);
  model.add(std::move(parts.trim), m.stone, "facade_trim", frame);
  model.add(std::move(parts.sash), m.white_wood, "window_frame", frame);
  model.add(std::move(parts.pane), m.pane, "window_pane", frame);
  model.add(std::move(parts.lit_pane), m.lit_pane, "lit_window", frame);
  model.add(std::move(parts.shutter), pick(m.shutter), "shutter", frame);
  model.add(std::move(parts.iron), m.iron, "railing", frame);
  model.add(std::move(parts.fabric), pick(m.fabric), "awning", frame);
  model.add(std::move(parts.fabric_2), m.canvas, "awning_stripe", frame);
  model.add(std::move(parts.leaf), m.leaf, "flower_box_leaves", frame);
  model.add(std::move(parts.flower), m.flower, "flower", frame);
  model.add(std::move(parts.pot), m.terracotta, "flower_box", frame);
}

}  // namespace hybray::procedural::street_parts
