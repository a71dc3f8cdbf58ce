// The street's plan: where the houses stand, the ground between them, and their roofs.
#include "core/scene/procedural/street.h"

#include <algorithm>

namespace hybray::procedural::street_parts {
namespace {

using Polygon = std::vector<dvec2>;  // (x, z); the public space lies to the right of each edge, seen from
                                     // above with z down the page

constexpr double kPavementWidth = 2.8, kDepth = 4.0;  // of a pavement, of a house
constexpr size_t kSquareFirst = 4, kSquareLast = 10;  // corners of the square
constexpr int kRoadCorner = 10;                       // of the kerb line: the last one on the north side

const Polygon& outline() {
  static const Polygon kOutline{
      {-46, -6.5},   {-38, -6.5},  {-29, -6.5},  {-20.5, -6.5}, {-12, -6.7},  {-12.6, -14}, {-12, -21.5},
      {-2.5, -22.6}, {7, -21.5},   {9.4, -13.5}, {10.5, -5.5},  {18.5, -2.9}, {27, -0.1},   {35.5, 2.6},
      {43, 5.1},     {39, 17.5},   {30.5, 14.7}, {21.5, 11.8},  {13, 9.0},    {4.5, 6.8},   {-4.5, 6.3},
      {-13, 6.3},    {-21.5, 6.5}, {-30, 6.5},   {-38, 6.5},    {-46, 6.5}};
  return kOutline;
}

// The polygon with every edge moved by `distance` into the public space (negative: into the houses), mitred.
Polygon inset(const Polygon& polygon, double distance) {
  const auto inward = [](const dvec2& a, const dvec2& b) {
    const dvec2 d = glm::normalize(b - a);
    return dvec2(-d.y, d.x);
  };
  Polygon result;
  const size_t n = polygon.size();
  for (size_t i = 0; i < n; ++i) {
    const dvec2 before = inward(polygon[(i + n - 1) % n], polygon[i]),
                after = inward(polygon[i], polygon[(i + 1) % n]);
    result.push_back(polygon[i] + distance * (before + after) / (1.0 + glm::dot(before, after)));
  }
  return result;
}

// Where the pavement ends; in front of the square it runs straight on.
Polygon kerb_line() {
  const Polygon along = inset(outline(), kPavementWidth);
  Polygon line(along.begin(), along.begin() + kSquareFirst);
  line.emplace_back(-11.0, -3.8);
  line.emplace_back(-1.0, -3.5);
  line.emplace_back(9.4, -2.7);
  line.insert(line.end(), along.begin() + kSquareLast + 1, along.end());
  return line;
}

double cross(const dvec2& a, const dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

// A flat polygon at height y, facing up, cut into triangles by clipping ears.
void flat_polygon(MeshBuilder& part, Polygon polygon, double y) {
  while (polygon.size() >= 3) {
    const size_t n = polygon.size();
    bool clipped = false;
    for (size_t i = 0; i < n && !clipped; ++i) {
      const dvec2 a = polygon[(i + n - 1) % n], b = polygon[i], c = polygon[(i + 1) % n];
      if (cross(b - a, c - b) <= 1e-9) continue;
      const bool empty = std::none_of(polygon.begin(), polygon.end(), [&](const dvec2& p) {
        return p != a && p != b && p != c && cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 &&
               cross(a - c, p - c) >= 0;
      });
      if (!empty) continue;
      const std::array<dvec3, 3> corners{dvec3(a.x, y, a.y), dvec3(c.x, y, c.y), dvec3(b.x, y, b.y)};
      part.face(corners);
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
      clipped = true;
    }
    if (!clipped) return;
  }
}

// Point at share t of a polyline's length.
dvec2 along(const Polygon& line, double t) {
  double length = 0.0;
  for (size_t i = 0; i + 1 < line.size(); ++i) length += glm::length(line[i + 1] - line[i]);
  double rest = t * length;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const double step = glm::length(line[i + 1] - line[i]);
    if (rest <= step) return glm::mix(line[i], line[i + 1], rest / step);
    rest -= step;
  }
  return line.back();
}

// The carriageway between the kerbs: cambered and a little uneven, or flat while there is little to spend.
void add_carriageway(MeshBuilder& part, const Lod& lod, const Polygon& edge) {
  if (!lod.wants(0.08)) return flat_polygon(part, edge, 0.0);
  const auto corner = edge.begin() + kRoadCorner;
  const Polygon north(edge.begin(), corner + 1), south(edge.rbegin(), std::make_reverse_iterator(corner + 1));
  const auto wave = [](double x, double z) {
    return 0.5 * std::sin(0.9 * x + 0.4 * z) + 0.3 * std::sin(2.1 * z - 1.3 * x) +
           0.2 * std::sin(3.7 * x + 2.9 * z);
  };
  part.surface(lod.segments(300, 90), lod.segments(28, 3), {}, [&](double u, double v) {
    const dvec2 p = glm::mix(along(south, u), along(north, u), v);
    const double inside = 4.0 * v * (1.0 - v);
    return dvec3(p.x, inside * (0.07 + 0.014 * wave(p.x, p.y)), p.y);
  });
}

// Paving slabs of the square, each a little higher or lower than the next.
void add_slabs(Model& model, const Materials& m, const Polygon& square) {
  if (!model.lod(key("slabs")).wants(0.2)) return;
  constexpr double kSize = 0.9, kJoint = 0.012, kMargin = 0.5;
  const auto inside = [&](const dvec2& p) {  // with room to the border
    bool odd = false;
    for (size_t i = 0; i < square.size(); ++i) {
      const dvec2 a = square[i], b = square[(i + 1) % square.size()], d = b - a;
      const double t = glm::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0);
      if (glm::length(a + t * d - p) < kMargin) return false;
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * d.x) odd = !odd;
    }
    return odd;
  };
  MeshBuilder light = model.part(), dark = model.part();
  for (int j = 0; j < 24; ++j)
    for (int i = 0; i < 28; ++i) {
      const double x = -13.0 + kSize * i + (j % 2 ? 0.5 * kSize : 0.0), z = -23.0 + kSize * j;
      const bool whole = inside({x, z}) && inside({x + kSize, z}) && inside({x, z + kSize}) &&
                         inside({x + kSize, z + kSize});
      if (!whole) continue;
      Dice dice = model.dice(key("slab", static_cast<uint64_t>(100 * j + i)));
      MeshBuilder& part = dice(0.0, 1.0) < 0.35 ? dark : light;
      const double top = kPavement + dice(0.012, 0.02);
      part.set_frame(moved({x + 0.5 * kSize, top, z + 0.5 * kSize}) *
                     turned(dice(-0.004, 0.004), dvec3(1, 0, 0)) *
                     turned(dice(-0.004, 0.004), dvec3(0, 0, 1)));
      const double half = 0.5 * kSize - kJoint;
      part.bevelled_box({-half, -0.06, -half}, {half, 0.0, half}, 0.008);
    }
  model.add(std::move(light), m.stone, "slab");
  model.add(std::move(dark), m.dark_stone, "slab_dark");
}

}  // namespace

std::vector<House> make_houses(const Model& model) {
  std::vector<House> houses;
  const Polygon& corners = outline();
  for (size_t i = 0; i < corners.size(); ++i) {
    const dvec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    const double length = glm::length(b - a);
    const dvec3 along((b.x - a.x) / length, 0, (b.y - a.y) / length), up(0, 1, 0);
    dmat4 frame(1.0);
    frame[0] = dvec4(along, 0), frame[1] = dvec4(up, 0), frame[2] = dvec4(glm::cross(along, up), 0);
    frame[3] = dvec4(a.x, 0, a.y, 1);
    Dice dice = model.dice(key("house", i));
    House house{{frame, length, i}, 0.0, dice(3.5, 4.0), 2 + dice.pick(3)};
    house.height = house.ground_floor + house.storeys * dice(2.9, 3.25) + 0.35;
    houses.push_back(house);
  }
  return houses;
}

void add_ground(Model& model, const Materials& m) {
  const Polygon kerb = kerb_line(), edge = inset(kerb, -0.1), walls = inset(outline(), -0.1);
  MeshBuilder road = model.part(), pavement = model.part(), stones = model.part();
  add_carriageway(road, model.lod(key("road")), edge);
  // Pavement: a strip along every house but those of the square, and the square itself. `skip` is how many
  // corners fewer the kerb has.
  const size_t n = walls.size(), k = kerb.size(), skip = n - k;
  const auto strip = [&](size_t wall, size_t at_kerb) {
    flat_polygon(pavement, {walls[wall], walls[(wall + 1) % n], edge[(at_kerb + 1) % k], edge[at_kerb]},
                 kPavement);
  };
  for (size_t i = 0; i < kSquareFirst; ++i) strip(i, i);
  for (size_t i = kSquareLast; i < n; ++i) strip(i, i - skip);
  Polygon square(walls.begin() + kSquareFirst, walls.begin() + kSquareLast + 1);
  for (size_t i = kSquareLast - skip + 1; i-- > kSquareFirst;) square.push_back(edge[i]);
  flat_polygon(pavement, square, kPavement);
  add_slabs(model, m, square);

  const std::array<dvec2, 5> profile{{{0, -0.03}, {0, 0.1}, {-0.035, 0.135}, {-0.22, 0.135}, {-0.22, 0.1}}};
  for (size_t j = 0; j + 1 < profile.size(); ++j) {
    const Polygon low = inset(kerb, profile[j].x), high = inset(kerb, profile[j + 1].x);
    for (size_t i = 0; i < k; ++i) {
      const size_t next = (i + 1) % k;
      const auto at = [](const dvec2& p, double y) { return dvec3(p.x, y, p.y); };
      stones.quad(at(low[i], profile[j].y), at(low[next], profile[j].y), at(high[next], profile[j + 1].y),
                  at(high[i], profile[j + 1].y));
    }
  }
  model.add(std::move(road), m.asphalt, "road");
  model.add(std::move(pavement), m.dark_stone, "pavement");
  model.add(std::move(stones), m.kerb, "kerb");
}

void add_roofs(Model& model, const Materials& m, const std::vector<House>& houses) {
  const Polygon& front = outline();
  const Polygon back = inset(front, -kDepth);
  const size_t n = front.size();
  const auto at = [](const dvec2& p, double y) { return dvec3(p.x, y, p.y); };
  const auto break_point = [&](size_t i) { return glm::mix(front[i], back[i], 0.3); };  // of the mansard
  for (size_t i = 0; i < n; ++i) {
    const size_t next = (i + 1) % n;
    const double h = houses[i].height;
    MeshBuilder roof = model.part(), gable = model.part();
    roof.quad(at(front[i], h), at(front[next], h), at(break_point(next), h + 2.3),
              at(break_point(i), h + 2.3));
    roof.quad(at(break_point(i), h + 2.3), at(break_point(next), h + 2.3), at(back[next], h + 2.9),
              at(back[i], h + 2.9));
    // The gable toward the next house, of whichever is taller.
    const double g = houses[next].height, low = std::min(h, g), high = std::max(h, g);
    const std::array<dvec2, 3> line{front[next], break_point(next), back[next]};
    const std::array<double, 3> rise{0.0, 2.3, 2.9};
    for (size_t j = 0; j + 1 < 3; ++j) {
      const dvec3 a = at(line[j], low + rise[j]), b = at(line[j + 1], low + rise[j + 1]);
      const dvec3 c = at(line[j + 1], high + rise[j + 1]), d = at(line[j], high + rise[j]);
      if (h > g)
        gable.quad(a, b, c, d);
      else
        gable.quad(b, a, d, c);
    }
    model.add(std::move(roof), m.slate, "roof");
    model.add(std::move(gable), m.plaster[houses[h > g ? i : next].front.number % 6], "gable");
    const Lod lod = model.lod(key("chimney", i));
    MeshBuilder stack = model.part(), pots = model.part();
    const double x = houses[i].front.length * 0.3;
    stack.box({x - 0.5, h + 1.5, -3.2}, {x + 0.5, h + 4.0, -2.6}, kAllFaces & ~kBottom & ~kBack);
    if (lod.wants(0.15)) stack.bevelled_box({x - 0.56, h + 3.9, -3.26}, {x + 0.56, h + 4.05, -2.54}, 0.03);
    for (const double offset : {-0.3, 0.0, 0.3}) {
      if (!lod.wants(0.2)) break;
      pots.set_frame(moved({x + offset, h + 4.03, -2.9}));
      lathe(pots, {{0.11, 0.0}, {0.09, 0.3}, {0.11, 0.4}, {0.07, 0.4}, {0.06, 0.2}}, lod.segments(10, 5));
    }
    model.add(std::move(stack), m.plaster[i % 6], "chimney", houses[i].front.frame);
    model.add(std::move(pots), m.terracotta, "chimney_pot", houses[i].front.frame);
  }
}

}  // namespace hybray::procedural::street_parts
