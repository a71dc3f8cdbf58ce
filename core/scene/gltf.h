// glTF 2.0 scenes, text (.gltf) and binary (.glb).
#pragma once

#include "core/scene/scene.h"

#include <filesystem>

namespace hybray {

// Loads the file's default scene (the first, where none is named): nodes with their transforms, triangle
// meshes, metallic-roughness factors, emissive factor and strength, KHR_materials_ior and _transmission,
// KHR_lights_punctual, perspective cameras. Triangles of zero area are left out. Throws InputError with the
// file and the place in it (a JSON pointer such as /accessors/3) for anything malformed: an index out of
// range, a value that is not finite, a missing or short buffer, a URI that leaves the file's folder, a cycle
// of nodes, counts beyond `max_triangles`.
Scene load_gltf(const std::filesystem::path& file, size_t max_triangles = size_t{1} << 28);

// Writes `scene` as binary glTF (.glb) by write-and-rename: one node and primitive an object, its materials,
// lights and cameras. Throws InputError for a scene with analytic surfaces or curves.
void save_gltf(const Scene& scene, const std::filesystem::path& file);

}  // namespace hybray
