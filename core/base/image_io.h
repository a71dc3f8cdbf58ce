// Image files, through OpenImageIO. What is written appears first under another name beside it and is then
// renamed, so that a broken file never stands under its name.
#pragma once

#include "core/base/image2d.h"
#include "core/base/vec.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace hybray {

// Writes width x height pixels of 8-bit sRGB, row by row from the top left, as PNG. Throws RuntimeError, with
// OpenImageIO's message, when it cannot be written.
void write_png(const std::filesystem::path& file, int width, int height, std::span<const uint8_t> rgb);

// Writes linear RGB by the file's extension: `.exr` in 32-bit float, exactly; `.hdr` in Radiance's shared
// exponent, to 1 % of a pixel's largest channel. Throws InputError for another extension and an image without
// pixels, RuntimeError when it cannot be written.
void write_radiance(const std::filesystem::path& file, const Image2D<vec3>& image);

// Reads the channels R, G and B of an `.exr` or `.hdr` file; NaN and infinity are read as they are. Throws
// InputError, with the file and OpenImageIO's message, for what is not such a file or has no such channels.
Image2D<vec3> read_radiance(const std::filesystem::path& file);

}  // namespace hybray
