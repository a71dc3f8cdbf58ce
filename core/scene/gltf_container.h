// The outer form of a glTF 2.0 file: text, or binary with its chunks (glTF 2.0 specification, section 4, "GLB
// File Format").
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace hybray {

struct GltfContainer {
  std::vector<unsigned char> bytes;    // the whole file
  std::string_view json;               // into bytes
  std::span<const unsigned char> bin;  // into bytes: the binary chunk, empty if there is none
};

// Reads a .gltf or .glb file, told apart by its first bytes. Throws InputError for a file that is missing or
// above 4 GiB (the format's own limit), and for a binary header or chunk whose lengths do not fit the file.
GltfContainer read_gltf_container(const std::filesystem::path& file);

}  // namespace hybray
