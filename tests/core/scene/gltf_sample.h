// A small valid glTF document for tests to change: two right triangles that form a unit square in the XY
// plane, facing +Z.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace hybray {

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// 48 bytes of positions, then 6 indices of 16 bits.
inline std::string sample_buffer() {
  return bytes_of<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) + bytes_of<uint16_t>({0, 1, 2, 0, 2, 3});
}

inline nlohmann::json sample_document(const std::string& uri = "data.bin") {
  nlohmann::json document = nlohmann::json::parse(R"({
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "name": "square"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "materials": [{"name": "paint", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 1],
                   "metallicFactor": 0.0, "roughnessFactor": 0.75}}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
       "min": [0, 0, 0], "max": [1, 1, 0]},
      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}
    ],
    "bufferViews": [
      {"buffer": 0, "byteOffset": 0, "byteLength": 48},
      {"buffer": 0, "byteOffset": 48, "byteLength": 12}
    ],
    "buffers": [{"byteLength": 60}]
  })");
  if (!uri.empty()) document["buffers"][0]["uri"] = uri;
  return document;
}

inline std::string u32(uint32_t value) {
  return bytes_of<uint32_t>({value});
}

// A binary glTF file of one JSON and one BIN chunk.
inline std::string glb(std::string text, std::string bin) {
  while (text.size() % 4 != 0) text += ' ';
  while (bin.size() % 4 != 0) bin += '\0';
  const auto size = [](const std::string& s) { return static_cast<uint32_t>(s.size()); };
  return "glTF" + u32(2) + u32(28 + size(text) + size(bin)) + u32(size(text)) + "JSON" + text +
         u32(size(bin)) + std::string("BIN\0", 4) + bin;
}

}  // namespace hybray
