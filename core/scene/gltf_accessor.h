// Typed arrays out of glTF's buffers (glTF 2.0 specification, section 3.6, "Binary Data Storage").
#pragma once

#include "core/base/vec.h"
#include "core/scene/gltf_buffers.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace hybray {

// A parsed and checked file: what the parts of the loader share.
struct GltfFile {
  const tinygltf::Model& model;
  const GltfBuffers& buffers;
  std::string name;  // of the file, for messages

  // "file: /pointer"
  std::string at(const std::string& pointer) const { return name + ": " + pointer; }
};

// All elements of a VEC3 accessor: float, or 8 and 16 bit integers, normalised or not
// (KHR_mesh_quantization). Throws InputError with the accessor's place for another type, for sparse
// accessors, for elements outside the buffer view (checked before anything is allocated) and for a value that
// is not finite.
std::vector<vec3> read_vec3(const GltfFile& file, size_t accessor);

// All elements of a SCALAR accessor of unsigned integers, 8, 16 or 32 bit; each must be below `limit`. Errors
// as above.
std::vector<uint32_t> read_indices(const GltfFile& file, size_t accessor, size_t limit);

}  // namespace hybray
