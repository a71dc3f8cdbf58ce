// Triangle meshes out of glTF primitives (glTF 2.0 specification, section 3.7.2, "Meshes").
#pragma once

#include "core/scene/gltf_accessor.h"
#include "core/scene/mesh.h"

namespace hybray {

// Number of triangles that a primitive states, zero-area ones included: 0 for points and lines, which have
// none. Read from the accessors' counts alone. Throws InputError for an unknown mode, a missing POSITION, or
// a list of triangles whose count is no multiple of 3.
size_t stated_triangles(const GltfFile& file, size_t mesh, size_t primitive);

// The triangles of a primitive (lists, strips, fans) in the mesh's own space, without those of zero area and
// without vertices that no triangle uses. A normal of length zero is replaced by that of a triangle at the
// vertex. Empty if nothing is left.
Mesh read_primitive(const GltfFile& file, size_t mesh, size_t primitive);

}  // namespace hybray
