#include "core/scene/gltf_container.h"

#include "core/base/error.h"
#include "core/scene/file_input.h"

#include <cstring>

#include <fmt/format.h>

namespace hybray {
namespace {

constexpr uint32_t kMagic = 0x46546c67;  // "glTF"
constexpr uint32_t kJson = 0x4e4f534a;   // "JSON"
constexpr uint32_t kBin = 0x004e4942;    // "BIN"
constexpr size_t kHeader = 12, kChunkHeader = 8;

uint32_t read_u32(std::span<const unsigned char> bytes, size_t offset) {
  return static_cast<uint32_t>(bytes[offset]) | static_cast<uint32_t>(bytes[offset + 1]) << 8 |
         static_cast<uint32_t>(bytes[offset + 2]) << 16 | static_cast<uint32_t>(bytes[offset + 3]) << 24;
}

void split_chunks(GltfContainer& container, const std::string& where) {
  std::span<const unsigned char> bytes = container.bytes;
  if (bytes.size() < kHeader + kChunkHeader) throw InputError(where, "the binary glTF header is cut short");
  if (const uint32_t version = read_u32(bytes, 4); version != 2)
    throw InputError(where, fmt::format("binary glTF version {} is not supported, only 2", version));
  const size_t length = read_u32(bytes, 8);
  if (length > bytes.size())
    throw InputError(where, fmt::format("the header states {} bytes, the file has {}", length, bytes.size()));
  bytes = bytes.first(length);

  bool has_json = false, has_bin = false;
  for (size_t offset = kHeader, number = 0; offset < length; ++number) {
    if (length - offset < kChunkHeader) throw InputError(where, fmt::format("chunk {} is cut short", number));
    const size_t size = read_u32(bytes, offset);
    const uint32_t type = read_u32(bytes, offset + 4);
    offset += kChunkHeader;
    if (size > length - offset)
      throw InputError(where,
                       fmt::format("chunk {} states {} bytes, {} are left", number, size, length - offset));
    const auto chunk = bytes.subspan(offset, size);
    if (number == 0 && type != kJson) throw InputError(where, "the first chunk is not JSON");
    if (type == kJson && !has_json) {
      container.json = {reinterpret_cast<const char*>(chunk.data()), chunk.size()};
      has_json = true;
    } else if (type == kBin && !has_bin) {
      container.bin = chunk;
      has_bin = true;
    }
    offset += size;
  }
  if (!has_json) throw InputError(where, "there is no JSON chunk");
}

}  // namespace

GltfContainer read_gltf_container(const std::filesystem::path& file) {
  const std::string where = file.string();
  GltfContainer container;
  container.bytes = read_file_bytes(file, where, 0xffffffffu);
  if (container.bytes.size() >= 4 && read_u32(container.bytes, 0) == kMagic)
    split_chunks(container, where);
  else
    container.json = {reinterpret_cast<const char*>(container.bytes.data()), container.bytes.size()};
  return container;
}

}  // namespace hybray
