#include "core/scene/gltf_accessor.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <tiny_gltf.h>

namespace hybray {
namespace {

// Where the elements of an accessor lie, after all bounds are known to hold.
struct Elements {
  const unsigned char* data;
  size_t count, stride;
};

Elements elements(const GltfFile& file, size_t index, int type, size_t component_bytes, int components) {
  const tinygltf::Accessor& accessor = file.model.accessors[index];
  const std::string where = file.at(fmt::format("/accessors/{}", index));
  if (accessor.type != type) throw InputError(where + "/type", "not the type that its use here needs");
  if (accessor.sparse.isSparse) throw InputError(where + "/sparse", "sparse accessors are not supported");
  if (accessor.bufferView < 0) throw InputError(where + "/bufferView", "missing");
  if (accessor.count == 0 || accessor.count > 0xffffffffu)
    throw InputError(where + "/count", fmt::format("{} is not between 1 and 2^32 - 1", accessor.count));

  const auto view_index = static_cast<size_t>(accessor.bufferView);
  const tinygltf::BufferView& view = file.model.bufferViews[view_index];
  const auto buffer = file.buffers[static_cast<size_t>(view.buffer)];
  if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
    throw InputError(file.at(fmt::format("/bufferViews/{}", view_index)),
                     fmt::format("{} bytes at offset {} leave the buffer of {} bytes", view.byteLength,
                                 view.byteOffset, buffer.size()));

  const size_t element = component_bytes * static_cast<size_t>(components);
  const size_t stride = view.byteStride == 0 ? element : view.byteStride;
  if (stride < element)
    throw InputError(file.at(fmt::format("/bufferViews/{}/byteStride", view_index)),
                     fmt::format("{} bytes are less than one element of {} bytes", stride, element));
  const size_t needed = (accessor.count - 1) * stride + element;  // below 2^41: count and stride are bounded
  if (accessor.byteOffset > view.byteLength || needed > view.byteLength - accessor.byteOffset)
    throw InputError(where, fmt::format("{} elements at offset {} leave the buffer view of {} bytes",
                                        accessor.count, accessor.byteOffset, view.byteLength));
  return {buffer.data() + view.byteOffset + accessor.byteOffset, accessor.count, stride};
}

template <class T>
T load(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

// glTF 2.0, section 3.11: a signed integer c of n bits means max(c / (2^(n-1) - 1), -1), an unsigned one c /
// (2^n - 1).
template <class T>
float component(const unsigned char* bytes, bool normalized) {
  const auto value = static_cast<float>(load<T>(bytes));
  if constexpr (std::is_integral_v<T>)
    if (normalized) return std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
  return value;
}

template <class T>
std::vector<vec3> read_vec3_as(const GltfFile& file, size_t accessor) {
  const Elements from = elements(file, accessor, TINYGLTF_TYPE_VEC3, sizeof(T), 3);
  const bool normalized = file.model.accessors[accessor].normalized;
  std::vector<vec3> values(from.count);
  for (size_t i = 0; i < from.count; ++i) {
    const unsigned char* bytes = from.data + i * from.stride;
    for (int c = 0; c < 3; ++c) {
      values[i][c] = component<T>(bytes + static_cast<size_t>(c) * sizeof(T), normalized);
      if (!std::isfinite(values[i][c]))
        throw InputError(file.at(fmt::format("/accessors/{}", accessor)),
                         fmt::format("element {} is not finite", i));
    }
  }
  return values;
}

template <class T>
std::vector<uint32_t> read_indices_as(const GltfFile& file, size_t accessor, size_t limit) {
  const Elements from = elements(file, accessor, TINYGLTF_TYPE_SCALAR, sizeof(T), 1);
  std::vector<uint32_t> values(from.count);
  for (size_t i = 0; i < from.count; ++i) {
    values[i] = load<T>(from.data + i * from.stride);
    if (values[i] >= limit)
      throw InputError(
          file.at(fmt::format("/accessors/{}", accessor)),
          fmt::format("element {} is vertex index {}; there are {} vertices", i, values[i], limit));
  }
  return values;
}

[[noreturn]] void refuse_component(const GltfFile& file, size_t accessor) {
  throw InputError(
      file.at(fmt::format("/accessors/{}/componentType", accessor)),
      fmt::format("{} is not a type that its use here allows", file.model.accessors[accessor].componentType));
}

}  // namespace

std::vector<vec3> read_vec3(const GltfFile& file, size_t accessor) {
  switch (file.model.accessors[accessor].componentType) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return read_vec3_as<float>(file, accessor);
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return read_vec3_as<int8_t>(file, accessor);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return read_vec3_as<uint8_t>(file, accessor);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return read_vec3_as<int16_t>(file, accessor);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return read_vec3_as<uint16_t>(file, accessor);
    default:
      refuse_component(file, accessor);
  }
}

std::vector<uint32_t> read_indices(const GltfFile& file, size_t accessor, size_t limit) {
  switch (file.model.accessors[accessor].componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return read_indices_as<uint8_t>(file, accessor, limit);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return read_indices_as<uint16_t>(file, accessor, limit);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return read_indices_as<uint32_t>(file, accessor, limit);
    default:
      refuse_component(file, accessor);
  }
}

}  // namespace hybray
