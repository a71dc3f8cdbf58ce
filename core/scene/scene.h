// A scene, ready to be traced: all triangles in world space in one flat list, analytic surfaces and curves
// beside them, with materials, lights and named cameras.
#pragma once

#include "core/base/vec.h"
#include "core/scene/analytic_surface.h"
#include "core/scene/camera.h"
#include "core/scene/light.h"
#include "core/scene/material.h"
#include "core/scene/mesh.h"
#include "core/scene/round_curve.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hybray {

// A run of consecutive triangles that came in as one mesh.
struct SceneObject {
  std::string name;
  uint32_t first_triangle = 0, triangle_count = 0;
  uint32_t material = 0;
};

struct Scene {
  std::string name;
  std::vector<vec3> positions;              // metres, world space
  std::vector<vec3> normals;                // unit shading normals, one a position
  std::vector<uvec3> triangles;             // into positions; a triangle's number here is its primitive id
  std::vector<uint32_t> triangle_material;  // into materials, one a triangle
  std::vector<SceneObject> objects;         // cover all triangles in order
  std::vector<AnalyticSurface> analytic;    // their primitive ids follow those of the triangles
  std::vector<RoundCurve> curves;           // theirs follow those of the analytic surfaces
  std::vector<Material> materials;
  std::vector<Light> lights;
  std::vector<Camera> cameras;
  Bounds3 bounds;
  uint64_t content_hash = 0;  // of everything above: equal scenes give equal results

  size_t triangle_count() const { return triangles.size(); }
  size_t primitive_count() const { return first_curve() + curves.size(); }
  size_t first_curve() const { return triangles.size() + analytic.size(); }  // its primitive id

  // Of a primitive id: what it is, the surface or curve of one that is no triangle
  // (core/scene/curved_primitive.h treats them alike), and the material of any primitive.
  bool is_triangle(uint32_t primitive) const { return primitive < triangles.size(); }
  bool is_analytic(uint32_t primitive) const { return !is_triangle(primitive) && !is_curve(primitive); }
  bool is_curve(uint32_t primitive) const { return primitive >= first_curve(); }
  const AnalyticSurface& analytic_surface(uint32_t primitive) const {
    return analytic[primitive - triangles.size()];
  }
  const RoundCurve& curve(uint32_t primitive) const { return curves[primitive - first_curve()]; }
  uint32_t material_of(uint32_t primitive) const {
    return is_triangle(primitive) ? triangle_material[primitive]
           : is_curve(primitive)  ? curve(primitive).material
                                  : analytic_surface(primitive).material;
  }
  // Whether parts of a triangle are cut out.
  bool is_cut_out(uint32_t triangle) const {
    return materials[triangle_material[triangle]].cut_out != CutOut::none;
  }
};

// `mesh` moved by `transform` (affine, with an inverse): computed in double, normals by the inverse
// transpose, winding flipped where it mirrors. The identity leaves every bit as it is.
Mesh transformed(const Mesh& mesh, const dmat4& transform);

// Appends `mesh`, moved by `transform` as above, as one object. Triangles of zero area, and those with a
// vertex that is not finite, must not be in it. Flat normals are made where it has none.
void append_mesh(Scene& scene, const Mesh& mesh, const mat4& transform, uint32_t material,
                 const std::string& name);

// Appends an analytic surface, whose material must be there. Throws as check_surface does.
void append_analytic(Scene& scene, const AnalyticSurface& surface);

// Appends a curve, whose material must be there. Throws as check_curve does.
void append_curve(Scene& scene, const RoundCurve& curve);

// The triangles of one object as a mesh of its own, with the vertices that they use, in the scene's order.
Mesh object_mesh(const Scene& scene, const SceneObject& object);

// Sets content_hash from the present contents. Loaders call it last.
void update_content_hash(Scene& scene);

// The camera of that name. Throws InputError, naming the cameras there are.
const Camera& find_camera(const Scene& scene, const std::string& name);

// Unit normal of a triangle's plane, in double from the float vertices; its side is that of the
// counter-clockwise front.
dvec3 geometric_normal(const Scene& scene, uint32_t triangle);

}  // namespace hybray
