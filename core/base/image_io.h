// Image files, through OpenImageIO.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace hybray {

// Writes width x height pixels of 8-bit sRGB, row by row from the top left, as PNG: first under another name
// beside it, then renamed, so that a broken file never stands under its name. Throws RuntimeError, with
// OpenImageIO's message, when it cannot be written.
void write_png(const std::filesystem::path& file, int width, int height, std::span<const uint8_t> rgb);

}  // namespace hybray
