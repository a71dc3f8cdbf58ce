// Builds one mesh from surfaces and flat faces. The same calls can also only count triangles, which is how a
// generator finds the tessellation that meets a wanted number before it makes a single vertex.
#pragma once

#include "core/base/vec.h"
#include "core/scene/mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace hybray::procedural {

// How the borders of a (u, v) grid are joined.
struct GridShape {
  bool closed_u = false;    // u = 1 is u = 0
  bool closed_v = false;    // v = 1 is v = 0
  bool pole_begin = false;  // all of v = 0 is one point
  bool pole_end = false;    // all of v = 1 is one point
};

// Triangles of a grid of nu x nv cells.
size_t grid_triangles(int nu, int nv, const GridShape& shape);

// Faces of a box, to leave out those that nobody can see.
enum BoxFace : unsigned {
  kLeft = 1,
  kRight = 2,
  kBottom = 4,
  kTop = 8,
  kBack = 16,
  kFront = 32,
  kAllFaces = 63
};

class MeshBuilder {
 public:
  explicit MeshBuilder(bool counting = false) : counting_(counting) {}

  bool counting() const { return counting_; }
  size_t triangle_count() const { return count_; }

  // Counts triangles that repeated shapes would add; only while counting.
  void add_count(size_t triangles) { count_ += triangles; }

  // Maps what is added from here on; must keep orientation (no mirroring).
  void set_frame(const dmat4& frame) { frame_ = frame; }
  const dmat4& frame() const { return frame_; }

  // A surface position(u, v) -> dvec3 over [0, 1]^2, cut into nu x nv cells, smooth except at folds sharper
  // than the cells can follow. Its front is the side of dP/du x dP/dv.
  template <class Position>
  void surface(int nu, int nv, const GridShape& shape, Position&& position) {
    count_ += grid_triangles(nu, nv, shape);
    if (counting_) return;
    const int columns = shape.closed_u ? nu : nu + 1, rows = shape.closed_v ? nv : nv + 1;
    std::vector<dvec3> points;
    points.reserve(static_cast<size_t>(columns) * static_cast<size_t>(rows));
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i)
        points.push_back(position(static_cast<double>(i) / nu, static_cast<double>(j) / nv));
    add_grid(points, nu, nv, shape);
  }

  // A flat convex polygon, counter-clockwise seen from its front, as a fan from its first corner.
  void face(std::span<const dvec3> corners);
  void quad(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d);

  // An axis-aligned box with flat faces, or only those in `faces`.
  void box(const dvec3& lower, const dvec3& upper, unsigned faces = kAllFaces);

  // A box whose edges are chamfered by `bevel` metres (44 triangles).
  void bevelled_box(const dvec3& lower, const dvec3& upper, double bevel);

  // The finished mesh; the builder is empty afterwards.
  Mesh take() { return std::exchange(mesh_, Mesh{}); }

 private:
  void add_grid(const std::vector<dvec3>& points, int nu, int nv, const GridShape& shape);

  // Gives a triangle a vertex of its own, with its own normal, wherever the surface folds more sharply than
  // its cells can follow, so that no shading normal points away from the triangle that carries it.
  void split_folds(size_t first_triangle);

  bool counting_;
  size_t count_ = 0;
  dmat4 frame_{1.0};
  Mesh mesh_;
};

}  // namespace hybray::procedural
