#include "core/scene/shapes.h"

#include "core/base/check.h"
#include "core/scene/mesh_cleanup.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hybray {
namespace {

// Adds a grid of cells x rows quads with the corner points point(i / cells, j / rows) and its normals; front
// where u x v points.
template <class Point, class Normal>
void add_grid(Mesh& mesh, int cells, int rows, const Point& point, const Normal& normal) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  const auto columns = static_cast<uint32_t>(cells + 1);
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= cells; ++i) {
      const double u = static_cast<double>(i) / cells, v = static_cast<double>(j) / rows;
      mesh.positions.push_back(vec3(point(u, v)));
      mesh.normals.push_back(vec3(normal(u, v)));
    }
  for (uint32_t j = 0; j < static_cast<uint32_t>(rows); ++j)
    for (uint32_t i = 0; i < static_cast<uint32_t>(cells); ++i) {
      const uint32_t a = first + j * columns + i, b = a + 1, c = b + columns, d = a + columns;
      mesh.triangles.emplace_back(a, b, c);
      mesh.triangles.emplace_back(a, c, d);
    }
}

// A unit square centred at `center`, facing u x v.
void add_square(Mesh& mesh, int cells, const dvec3& center, const dvec3& u_axis, const dvec3& v_axis) {
  const dvec3 n = glm::cross(u_axis, v_axis);
  add_grid(
      mesh, cells, cells,
      [&](double u, double v) { return center + (u - 0.5) * u_axis + (v - 0.5) * v_axis; },
      [&](double, double) { return n; });
}

// A point of the unit circle in XZ at u turns from +X towards -Z: counter-clockwise seen from above. Whole
// turns meet exactly.
dvec3 on_circle(double u) {
  const double angle = 2.0 * std::numbers::pi * (u >= 1.0 ? 0.0 : u);
  return dvec3(std::cos(angle), 0.0, -std::sin(angle));
}

Mesh sphere(int around) {
  Mesh mesh;
  const auto point = [](double u, double v) {
    if (v <= 0.0 || v >= 1.0) return dvec3(0.0, v <= 0.0 ? -1.0 : 1.0, 0.0);
    const double latitude = std::numbers::pi * (v - 0.5);
    return std::cos(latitude) * on_circle(u) + dvec3(0.0, std::sin(latitude), 0.0);
  };
  add_grid(mesh, around, std::max(2, around / 2), point, point);
  return mesh;
}

Mesh cylinder(int around) {
  Mesh mesh;
  const dvec3 up(0.0, 1.0, 0.0);
  add_grid(
      mesh, around, 1, [&](double u, double v) { return on_circle(u) + (v - 0.5) * up; },
      [](double u, double) { return on_circle(u); });
  for (const double side : {1.0, -1.0})
    add_grid(
        mesh, around, 1,
        [&](double u, double v) { return (1.0 - v) * on_circle(side > 0.0 ? u : 1.0 - u) + 0.5 * side * up; },
        [&](double, double) { return side * up; });
  return mesh;
}

Mesh box(int cells) {
  Mesh mesh;
  const dvec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int k = 0; k < 3; ++k) {
    const dvec3 &u = axes[(k + 1) % 3], &v = axes[(k + 2) % 3];
    add_square(mesh, cells, 0.5 * axes[k], u, v);
    add_square(mesh, cells, -0.5 * axes[k], v, u);
  }
  return mesh;
}

Mesh plane(int cells) {
  Mesh mesh;
  add_square(mesh, cells, dvec3(0.0), dvec3(0.0, 0.0, 1.0), dvec3(1.0, 0.0, 0.0));
  return mesh;
}

}  // namespace

const std::vector<std::string>& shape_names() {
  static const std::vector<std::string> kNames = {"sphere", "box", "plane", "cylinder"};
  return kNames;
}

int default_tessellation(const std::string& shape) {
  return shape == "sphere" || shape == "cylinder" ? 64 : 1;
}

Mesh make_shape(const std::string& shape, int tessellation) {
  const bool round = shape == "sphere" || shape == "cylinder";
  HYBRAY_CHECK_LE(round ? 3 : 1, tessellation);
  Mesh mesh = shape == "sphere"  ? sphere(tessellation)
              : shape == "box"   ? box(tessellation)
              : shape == "plane" ? plane(tessellation)
                                 : cylinder(tessellation);
  remove_zero_area(mesh);  // at the poles and the centres of the ends
  remove_unused_vertices(mesh);
  return mesh;
}

}  // namespace hybray
