// A batch of a converged reference as bytes, for the cache: exact, so that a batch read back is the batch
// made.
#pragma once

#include "core/truth/caustic_reference.h"

#include <optional>
#include <string>
#include <string_view>

namespace hybray::caustics_parts {

// Of the layout below; part of the cache's keys.
constexpr int kBatchFormat = 1;

// Sizes, sums and counts, then the images as float32, three channels, row by row: illumination, and where the
// batch has them mixed and mixed_wide.
std::string to_bytes(const truth::CausticReferenceBatch& batch);

// Nothing where these are not the bytes of a batch of this size.
std::optional<truth::CausticReferenceBatch> batch_from_bytes(std::string_view bytes, int width, int height);

}  // namespace hybray::caustics_parts
