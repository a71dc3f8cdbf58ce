#include "core/scene/gltf_buffers.h"

#include "core/base/error.h"
#include "core/scene/file_input.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

namespace hybray {
namespace {

constexpr size_t kMaxBufferBytes = size_t{1} << 35;

std::vector<unsigned char> read_uri(const std::string& uri, const std::filesystem::path& folder,
                                    const std::string& where) {
  if (uri.rfind("data:", 0) != 0)
    return read_file_bytes(confined_path(folder, uri, where), where, kMaxBufferBytes);
  std::vector<unsigned char> bytes;
  std::string type;
  if (!tinygltf::IsDataURI(uri) || !tinygltf::DecodeDataURI(&bytes, type, uri, 0, false))
    throw InputError(where,
                     "the data URI is empty or not of the form data:application/octet-stream;base64,...");
  return bytes;
}

}  // namespace

GltfBuffers::GltfBuffers(const nlohmann::json& document, const GltfContainer& container,
                         const std::filesystem::path& file) {
  const auto buffers = document.find("buffers");
  if (buffers == document.end()) return;
  owned_.resize(buffers->size());
  for (size_t i = 0; i < buffers->size(); ++i) {
    const nlohmann::json& buffer = (*buffers)[i];
    const std::string where = fmt::format("{}: /buffers/{}", file.string(), i);
    std::span<const unsigned char> bytes;
    if (const auto uri = buffer.find("uri"); uri != buffer.end()) {
      owned_[i] = read_uri(uri->get_ref<const std::string&>(), file.parent_path(), where + "/uri");
      bytes = owned_[i];
    } else if (i == 0 && !container.bin.empty()) {
      bytes = container.bin;
    } else {
      throw InputError(where, "has no uri, and there is no binary chunk for it");
    }
    const auto length = buffer["byteLength"].get<uint64_t>();
    if (length > bytes.size())
      throw InputError(where + "/byteLength",
                       fmt::format("states {} bytes, there are {}", length, bytes.size()));
    buffers_.push_back(bytes.first(length));
  }
}

}  // namespace hybray
