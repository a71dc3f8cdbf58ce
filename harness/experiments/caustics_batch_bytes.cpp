#include "harness/experiments/caustics_batch_bytes.h"

#include <cstring>
#include <type_traits>

namespace hybray::caustics_parts {
namespace {

using truth::CausticReferenceBatch;

// Everything but the images. No padding: the bytes of equal batches are equal.
struct BatchHeader {
  int32_t width = 0, height = 0;
  uint64_t has_mixed = 0;
  caustics::FluxLedger ledger;
  caustics::SplatCounts counts;
  uint64_t rays = 0, paths = 0, overflows = 0;
};
static_assert(std::is_trivially_copyable_v<BatchHeader>);
static_assert(sizeof(BatchHeader) == 8 + 8 + 7 * 8 + 4 * 8 + 3 * 8, "a new member is a new kBatchFormat");
static_assert(sizeof(vec3) == 12);

void append(std::string& bytes, const Image2D<vec3>& image) {
  bytes.append(reinterpret_cast<const char*>(image.data()), image.size() * sizeof(vec3));
}

void take(std::string_view& bytes, Image2D<vec3>& image, int width, int height) {
  image = Image2D<vec3>(width, height);
  std::memcpy(static_cast<void*>(image.data()), bytes.data(), image.size() * sizeof(vec3));
  bytes.remove_prefix(image.size() * sizeof(vec3));
}

}  // namespace

std::string to_bytes(const CausticReferenceBatch& batch) {
  const BatchHeader header{batch.illumination.width(),
                           batch.illumination.height(),
                           !batch.mixed.empty(),
                           batch.ledger,
                           batch.counts,
                           batch.rays,
                           batch.paths,
                           batch.overflows};
  std::string bytes;
  bytes.reserve(sizeof header + 3 * batch.illumination.size() * sizeof(vec3));
  bytes.append(reinterpret_cast<const char*>(&header), sizeof header);
  for (const Image2D<vec3>* image : {&batch.illumination, &batch.mixed, &batch.mixed_wide})
    append(bytes, *image);
  return bytes;
}

std::optional<CausticReferenceBatch> batch_from_bytes(std::string_view bytes, int width, int height) {
  BatchHeader header;
  if (bytes.size() < sizeof header) return std::nullopt;
  std::memcpy(&header, bytes.data(), sizeof header);
  bytes.remove_prefix(sizeof header);
  const size_t image_bytes = static_cast<size_t>(width) * static_cast<size_t>(height) * sizeof(vec3);
  if (header.width != width || header.height != height || header.has_mixed > 1 ||
      bytes.size() != (header.has_mixed ? 3 : 1) * image_bytes)
    return std::nullopt;
  CausticReferenceBatch batch;
  batch.ledger = header.ledger, batch.counts = header.counts;
  batch.rays = header.rays, batch.paths = header.paths, batch.overflows = header.overflows;
  take(bytes, batch.illumination, width, height);
  if (header.has_mixed) {
    take(bytes, batch.mixed, width, height);
    take(bytes, batch.mixed_wide, width, height);
  }
  return batch;
}

}  // namespace hybray::caustics_parts
