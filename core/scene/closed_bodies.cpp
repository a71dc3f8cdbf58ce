#include "core/scene/closed_bodies.h"

#include "core/base/error.h"
#include "core/base/hash.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace hybray {
namespace {

// Below it a transmitting surface refracts; a rougher one lets nothing through that is followed.
constexpr float kSmooth = 0.1f;

bool is_interface(const Material& m) {
  return m.transmission > 0.0f && !m.thin_walled && m.metallic < 1.0f && m.roughness < kSmooth;
}

// How wide a crack may be, as a share of the longer edge beside it. Where two meshes of one curve have
// different vertices, their edges part by about length^2 / (8 radius): 1/40 of the length for 32 edges
// around.
constexpr double kCrack = 0.05;

using Medium = std::tuple<float, float, float, float>;  // ior, absorption
const Medium kEmpty{1.0f, 0.0f, 0.0f, 0.0f};

Medium inner_medium(const Material& m) {
  return {m.ior, m.absorption.x, m.absorption.y, m.absorption.z};
}
Medium outer_medium(const Material& m) {
  return {m.outer_ior, m.outer_absorption.x, m.outer_absorption.y, m.outer_absorption.z};
}

struct PositionHash {
  size_t operator()(const vec3& p) const { return hash_bytes(&p, sizeof p, 0); }
};

// Gives vertices in the same place the same number.
class Welder {
 public:
  uint32_t operator()(const vec3& position) {
    const vec3 p = position + vec3(0.0f);  // -0 becomes +0, which has other bits and is the same place
    return numbers_.try_emplace(p, static_cast<uint32_t>(numbers_.size())).first->second;
  }
  size_t size() const { return numbers_.size(); }

 private:
  std::unordered_map<vec3, uint32_t, PositionHash> numbers_;
};

// Faces that bound one medium: `side` is 1 where it lies behind them, -1 where it lies before them.
struct Face {
  uvec3 vertices;  // welded
  uint32_t object, triangle;
  int side;
};
using Boundary = std::vector<Face>;

// The side of a material's faces that bounds `medium`, 0 if none or both do.
int side_of(const Material& m, const Medium& medium) {
  const bool behind = is_interface(m) && inner_medium(m) == medium;
  const bool before = !(m.thin_walled && m.transmission > 0.0f) && outer_medium(m) == medium;
  return (behind ? 1 : 0) - (before ? 1 : 0);
}

std::vector<Medium> media_of(const Scene& scene) {
  std::vector<Medium> media;
  for (const SceneObject& object : scene.objects) {
    const Material& m = scene.materials[object.material];
    if (object.triangle_count == 0 || !is_interface(m)) continue;
    for (const Medium& medium : {inner_medium(m), outer_medium(m)})
      if (medium != kEmpty) media.push_back(medium);
  }
  std::sort(media.begin(), media.end());
  media.erase(std::unique(media.begin(), media.end()), media.end());
  return media;
}

Boundary boundary_of(const Scene& scene, const Medium& medium, Welder& weld) {
  Boundary boundary;
  for (uint32_t o = 0; o < scene.objects.size(); ++o) {
    const SceneObject& object = scene.objects[o];
    const int side = side_of(scene.materials[object.material], medium);
    if (side == 0) continue;
    for (uint32_t t = object.first_triangle; t < object.first_triangle + object.triangle_count; ++t) {
      const uvec3& tri = scene.triangles[t];
      const auto number = [&](uint32_t vertex) { return weld(scene.positions[vertex]); };
      boundary.push_back({{number(tri.x), number(tri.y), number(tri.z)}, o, t, side});
    }
  }
  return boundary;
}

// An edge that runs more often one way than the other: from `a` to `b` if `net` is positive.
struct OpenEdge {
  vec3 a, b;
  int net;
  uint32_t object;
};

std::vector<OpenEdge> open_edges(const Scene& scene, const Boundary& boundary) {
  struct Use {
    int net = 0;  // from the lower to the higher vertex, less the other way
    uint32_t face = 0;
    uint32_t low = 0, high = 0;  // the scene's vertices
  };
  std::unordered_map<uint64_t, Use> uses;
  uses.reserve(2 * boundary.size());
  for (uint32_t f = 0; f < boundary.size(); ++f) {
    const Face& face = boundary[f];
    const uvec3& tri = scene.triangles[face.triangle];
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      const uint32_t a = face.vertices[k], b = face.vertices[next];
      if (a == b) continue;
      Use& use = uses[(uint64_t{std::min(a, b)} << 32) | std::max(a, b)];
      use.net += a < b ? face.side : -face.side;
      use.face = f;
      use.low = a < b ? tri[k] : tri[next];
      use.high = a < b ? tri[next] : tri[k];
    }
  }
  std::vector<std::pair<uint64_t, Use>> open;
  for (const auto& [key, use] : uses)
    if (use.net != 0) open.emplace_back(key, use);
  // The table has no order of its own that could be relied upon.
  std::sort(open.begin(), open.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<OpenEdge> edges;
  for (const auto& [key, use] : open)
    edges.push_back(
        {scene.positions[use.low], scene.positions[use.high], use.net, boundary[use.face].object});
  return edges;
}

double distance_to_segment(const dvec3& p, const dvec3& a, const dvec3& b) {
  const dvec3 ab = b - a;
  return glm::distance(p, a + glm::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0) * ab);
}

// Whether `point` of `edge` lies at an edge that runs the other way, as the two sides of a crack do.
bool has_other_side(const dvec3& point, const OpenEdge& edge, const std::vector<OpenEdge>& edges) {
  const dvec3 along = dvec3(edge.b) - dvec3(edge.a);
  const double length = glm::length(along);
  return std::any_of(edges.begin(), edges.end(), [&](const OpenEdge& other) {
    const dvec3 a(other.a), b(other.b);
    const double other_length = glm::distance(a, b);
    const double turn = glm::dot(along, b - a) / (length * other_length) * edge.net * other.net;
    return turn < -0.9 && distance_to_segment(point, a, b) <= kCrack * std::max(length, other_length);
  });
}

// Leaves out the edges of cracks. Whoever has more open edges than any crack has, has holes.
void forgive_cracks(std::vector<OpenEdge>& edges) {
  constexpr size_t kMost = 4096;
  if (edges.size() > kMost) return;
  std::vector<OpenEdge> holes;
  for (const OpenEdge& edge : edges) {
    const dvec3 a(edge.a), b(edge.b);
    const bool crack = has_other_side(a, edge, edges) && has_other_side(0.5 * (a + b), edge, edges) &&
                       has_other_side(b, edge, edges);
    if (!crack) holes.push_back(edge);
  }
  edges = std::move(holes);
}

std::map<uint32_t, BodyFault> by_object(const std::vector<OpenEdge>& edges) {
  std::map<uint32_t, BodyFault> faults;
  for (const OpenEdge& edge : edges) {
    BodyFault& fault = faults[edge.object];
    if (fault.open_edges == 0) fault.place = 0.5f * (edge.a + edge.b);
    fault.open_edges += static_cast<size_t>(std::abs(edge.net));
  }
  return faults;
}

// A connected piece of a closed boundary; all of it where cracks part what belongs together.
struct Piece {
  Bounds3 bounds;
  double volume = 0.0;
  bool has_inside = false;  // some face has the medium behind it
  uint32_t object = 0;
  vec3 vertex{0.0f};
};

bool contains(const Bounds3& outer, const Bounds3& inner) {
  return glm::all(glm::lessThanEqual(outer.lower, inner.lower)) &&
         glm::all(glm::greaterThanEqual(outer.upper, inner.upper));
}

std::vector<Piece> pieces_of(const Scene& scene, const Boundary& boundary, size_t vertices, bool cracked) {
  std::vector<uint32_t> parent(vertices);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Face& face : boundary)
    for (int k = 1; k < 3; ++k) parent[root(face.vertices[k])] = root(face.vertices[0]);
  std::map<uint32_t, Piece> pieces;
  const dvec3 middle = 0.5 * (dvec3(scene.bounds.lower) + dvec3(scene.bounds.upper));
  for (const Face& face : boundary) {
    const uvec3& tri = scene.triangles[face.triangle];
    const auto [at, added] = pieces.try_emplace(cracked ? 0 : root(face.vertices[0]));
    Piece& piece = at->second;
    if (added) piece.object = face.object, piece.vertex = scene.positions[tri.x];
    dvec3 p[3];
    for (int k = 0; k < 3; ++k) {
      piece.bounds.extend(scene.positions[tri[k]]);
      p[k] = dvec3(scene.positions[tri[k]]) - middle;
    }
    piece.volume += face.side * glm::dot(p[0], glm::cross(p[1], p[2])) / 6.0;
    piece.has_inside |= face.side > 0;
  }
  std::vector<Piece> list;
  for (const auto& [ignored, piece] : pieces) list.push_back(piece);
  return list;
}

std::map<uint32_t, BodyFault> inside_out(const std::vector<Piece>& pieces) {
  std::map<uint32_t, BodyFault> faults;
  for (const Piece& piece : pieces) {
    if (piece.volume >= 0.0 || !piece.has_inside) continue;
    const bool bubble = std::any_of(pieces.begin(), pieces.end(), [&](const Piece& other) {
      return other.volume > 0.0 && contains(other.bounds, piece.bounds);
    });
    if (!bubble) faults[piece.object].place = piece.vertex;
  }
  return faults;
}

// A sphere and the body of a field close by themselves; the other analytic surfaces end at their rims.
void add_analytic_faults(const Scene& scene, std::vector<BodyFault>& faults) {
  for (const AnalyticSurface& surface : scene.analytic) {
    const Material& m = scene.materials[surface.material];
    if (surface.kind == AnalyticSurface::Kind::sphere || surface.kind == AnalyticSurface::Kind::field ||
        !is_interface(m))
      continue;
    const size_t rims = surface.kind == AnalyticSurface::Kind::cylinder ? 2 : 1;
    faults.push_back({surface.name, m.name, m.ior, rims, vec3(surface.center)});
  }
}

// Curves are open at both ends: one fault for those of a material.
void add_curve_faults(const Scene& scene, std::vector<BodyFault>& faults) {
  std::map<uint32_t, BodyFault> by_material;
  for (const RoundCurve& curve : scene.curves) {
    const Material& m = scene.materials[curve.material];
    if (!is_interface(m)) continue;
    const auto [at, added] = by_material.try_emplace(curve.material);
    BodyFault& fault = at->second;
    if (added) fault = {"curves", m.name, m.ior, 0, vec3(curve.control[0])};
    fault.open_edges += 2;
  }
  for (const auto& [material, fault] : by_material) faults.push_back(fault);
}

}  // namespace

std::vector<BodyFault> find_body_faults(const Scene& scene) {
  std::vector<BodyFault> all;
  for (const Medium& medium : media_of(scene)) {
    Welder weld;
    const Boundary boundary = boundary_of(scene, medium, weld);
    std::vector<OpenEdge> edges = open_edges(scene, boundary);
    const bool cracked = !edges.empty();
    forgive_cracks(edges);
    auto faults =
        edges.empty() ? inside_out(pieces_of(scene, boundary, weld.size(), cracked)) : by_object(edges);
    for (auto& [object, fault] : faults) {
      fault.object = scene.objects[object].name;
      fault.material = scene.materials[scene.objects[object].material].name;
      fault.ior = std::get<0>(medium);
      all.push_back(fault);
    }
  }
  add_analytic_faults(scene, all);
  add_curve_faults(scene, all);
  return all;
}

void check_closed_bodies(const Scene& scene) {
  const std::vector<BodyFault> faults = find_body_faults(scene);
  if (faults.empty()) return;
  const BodyFault& f = faults.front();
  const std::string where =
      fmt::format("scene {}: object '{}' of material '{}'", scene.name, f.object, f.material);
  const std::string place = fmt::format("({}, {}, {})", f.place.x, f.place.y, f.place.z);
  const std::string others =
      faults.size() > 1 ? fmt::format("; {} more objects have open or inverted surfaces", faults.size() - 1)
                        : "";
  if (f.open_edges == 0)
    throw InputError(where,
                     fmt::format("its surface is inside out, near {}: turn its faces, so that they point "
                                 "away from the medium of index {}{}",
                                 place, f.ior, others));
  throw InputError(where,
                   fmt::format("the surface of the medium of index {} is open at {} edges, one at {}: close "
                               "it, or make the material thin_walled if it is a sheet{}",
                               f.ior, f.open_edges, place, others));
}

}  // namespace hybray
