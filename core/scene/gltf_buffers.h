// The bytes behind a glTF file's buffers, wherever they are kept.
#pragma once

#include "core/scene/gltf_container.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace hybray {

class GltfBuffers {
 public:
  // Reads the buffers of a checked document: the container's binary chunk (which must outlive this), data
  // URIs, and files in the folder of `file`. Throws InputError with the buffer's place if one is missing,
  // shorter than it states, or outside the folder.
  GltfBuffers(const nlohmann::json& document, const GltfContainer& container,
              const std::filesystem::path& file);

  size_t size() const { return buffers_.size(); }
  std::span<const unsigned char> operator[](size_t buffer) const { return buffers_[buffer]; }

 private:
  std::vector<std::vector<unsigned char>> owned_;
  std::vector<std::span<const unsigned char>> buffers_;
};

}  // namespace hybray
