#include "core/scene/procedural/mesh_builder.h"

#include <array>

namespace hybray::procedural {

size_t grid_triangles(int nu, int nv, const GridShape& shape) {
  const int poles = (shape.pole_begin ? 1 : 0) + (shape.pole_end ? 1 : 0);
  return static_cast<size_t>(nu) * static_cast<size_t>(2 * nv - poles);
}

void MeshBuilder::add_grid(const std::vector<dvec3>& points, int nu, int nv, const GridShape& shape) {
  const int columns = shape.closed_u ? nu : nu + 1, rows = shape.closed_v ? nv : nv + 1;
  const auto first = static_cast<uint32_t>(mesh_.positions.size());
  const size_t first_triangle = mesh_.triangles.size();
  std::vector<uint32_t> index(points.size());
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const auto at = static_cast<size_t>(j * columns + i);
      const bool pole = (shape.pole_begin && j == 0) || (shape.pole_end && j == nv);
      if (pole && i > 0) {
        index[at] = index[at - 1];
        continue;
      }
      index[at] = static_cast<uint32_t>(mesh_.positions.size());
      mesh_.positions.push_back(vec3(dvec3(frame_ * dvec4(points[at], 1.0))));
    }
  std::vector<dvec3> normals(mesh_.positions.size() - first, dvec3(0.0));
  const auto triangle = [&](uint32_t a, uint32_t b, uint32_t c) {
    mesh_.triangles.emplace_back(a, b, c);
    const dvec3 p(mesh_.positions[a]), q(mesh_.positions[b]), r(mesh_.positions[c]);
    const dvec3 n = glm::cross(q - p, r - p);  // its length weighs the triangle by its area
    for (uint32_t v : {a, b, c}) normals[v - first] += n;
  };
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const auto at = [&](int column, int row) {
        return index[static_cast<size_t>((row % rows) * columns + column % columns)];
      };
      const uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (!(shape.pole_begin && j == 0)) triangle(a, b, c);
      if (!(shape.pole_end && j == nv - 1)) triangle(a, c, d);
    }
  for (const dvec3& n : normals) mesh_.normals.push_back(vec3(glm::normalize(n)));
  split_folds(first_triangle);
}

void MeshBuilder::split_folds(size_t first_triangle) {
  constexpr double kFold = 0.2;  // cosine
  for (size_t t = first_triangle; t < mesh_.triangles.size(); ++t) {
    uvec3& tri = mesh_.triangles[t];
    const dvec3 a(mesh_.positions[tri.x]), b(mesh_.positions[tri.y]), c(mesh_.positions[tri.z]);
    const dvec3 n = glm::normalize(glm::cross(b - a, c - a));
    for (int k = 0; k < 3; ++k) {
      if (glm::dot(n, dvec3(mesh_.normals[tri[k]])) >= kFold) continue;
      mesh_.positions.push_back(vec3(mesh_.positions[tri[k]]));
      mesh_.normals.push_back(vec3(n));
      tri[k] = static_cast<uint32_t>(mesh_.positions.size() - 1);
    }
  }
}

void MeshBuilder::face(std::span<const dvec3> corners) {
  count_ += corners.size() - 2;
  if (counting_) return;
  const auto first = static_cast<uint32_t>(mesh_.positions.size());
  for (const dvec3& p : corners) mesh_.positions.push_back(vec3(dvec3(frame_ * dvec4(p, 1.0))));
  dvec3 normal(0.0);
  const dvec3 a(mesh_.positions[first]);
  for (uint32_t i = 2; i < corners.size(); ++i) {
    normal += glm::cross(dvec3(mesh_.positions[first + i - 1]) - a, dvec3(mesh_.positions[first + i]) - a);
    mesh_.triangles.emplace_back(first, first + i - 1, first + i);
  }
  mesh_.normals.resize(mesh_.positions.size(), vec3(glm::normalize(normal)));
}

void MeshBuilder::quad(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
  const std::array<dvec3, 4> corners{a, b, c, d};
  face(corners);
}

void MeshBuilder::box(const dvec3& lo, const dvec3& hi, unsigned faces) {
  const auto p = [&](int x, int y, int z) {
    return dvec3(x ? hi.x : lo.x, y ? hi.y : lo.y, z ? hi.z : lo.z);
  };
  if (faces & kLeft) quad(p(0, 0, 0), p(0, 0, 1), p(0, 1, 1), p(0, 1, 0));
  if (faces & kRight) quad(p(1, 0, 1), p(1, 0, 0), p(1, 1, 0), p(1, 1, 1));
  if (faces & kBottom) quad(p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1));
  if (faces & kTop) quad(p(0, 1, 1), p(1, 1, 1), p(1, 1, 0), p(0, 1, 0));
  if (faces & kBack) quad(p(1, 0, 0), p(0, 0, 0), p(0, 1, 0), p(1, 1, 0));
  if (faces & kFront) quad(p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1));
}

void MeshBuilder::bevelled_box(const dvec3& lo, const dvec3& hi, double bevel) {
  const dvec3 center = 0.5 * (lo + hi), half = 0.5 * (hi - lo), inner = half - dvec3(bevel);
  // Corner (sx, sy, sz), pulled in along every axis but `axis`: it lies on that axis' face.
  const auto corner = [&](dvec3 sign, int axis) {
    dvec3 p = inner;
    p[axis] = half[axis];
    return center + sign * p;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (double s : {-1.0, 1.0}) {
      const auto at = [&](double su, double sv, int on) {
        dvec3 sign;
        sign[axis] = s, sign[u] = su * s, sign[v] = sv;
        return corner(sign, on);
      };
      quad(at(-1, -1, axis), at(1, -1, axis), at(1, 1, axis), at(-1, 1, axis));
      // The chamfer between this face and the next axis' face on the side su * s, once for each of the twelve
      // edges.
      for (double su : {-1.0, 1.0}) {
        if (su > 0)
          quad(at(su, -1, axis), at(su, -1, u), at(su, 1, u), at(su, 1, axis));
        else
          quad(at(su, 1, axis), at(su, 1, u), at(su, -1, u), at(su, -1, axis));
      }
    }
  }
  for (int c = 0; c < 8; ++c) {
    const dvec3 sign(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1);
    const bool even = sign.x * sign.y * sign.z > 0;
    const std::array<dvec3, 3> corners{corner(sign, 0), corner(sign, even ? 1 : 2),
                                       corner(sign, even ? 2 : 1)};
    face(corners);
  }
}

}  // namespace hybray::procedural
