#include "core/base/image_io.h"

#include "core/base/check.h"
#include "core/base/error.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <OpenImageIO/imageio.h>

namespace hybray {
namespace {

// Writes `pixels` of `type` in the given format, under another name first.
void write_image(const std::filesystem::path& file, const char* format, const OIIO::ImageSpec& spec,
                 OIIO::TypeDesc type, const void* pixels) {
  std::filesystem::path partial = file;
  partial += ".partial";
  const auto fail = [&](const std::string& why) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw RuntimeError("cannot write " + file.string() + ": " + why);
  };
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  if (!output) fail(OIIO::geterror());
  if (!output->open(partial.string(), spec)) fail(output->geterror());
  if (!output->write_image(type, pixels) || !output->close()) fail(output->geterror());
  std::error_code error;
  std::filesystem::rename(partial, file, error);
  if (error) fail(error.message());
}

// OpenImageIO's name of the format that the extension stands for; null for others.
const char* radiance_format(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".exr") return "openexr";
  return extension == ".hdr" ? "hdr" : nullptr;
}

const char* require_format(const std::filesystem::path& file) {
  const char* format = radiance_format(file);
  if (!format) throw InputError(file.string(), "radiance is kept in .exr or .hdr files");
  return format;
}

}  // namespace

void write_png(const std::filesystem::path& file, int width, int height, std::span<const uint8_t> rgb) {
  HYBRAY_CHECK_EQ(rgb.size(), size_t{3} * static_cast<size_t>(width) * static_cast<size_t>(height));
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("png:compressionLevel",
                 3);  // low: quick to write, and nobody keeps these pictures for their size
  write_image(file, "png", spec, OIIO::TypeDesc::UINT8, rgb.data());
}

void write_radiance(const std::filesystem::path& file, const Image2D<vec3>& image) {
  const char* format = require_format(file);
  if (image.empty()) throw InputError(file.string(), "an image without pixels cannot be written");
  static_assert(sizeof(vec3) == 3 * sizeof(float));
  OIIO::ImageSpec spec(image.width(), image.height(), 3, OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  write_image(file, format, spec, OIIO::TypeDesc::FLOAT, image.data());
}

Image2D<vec3> read_radiance(const std::filesystem::path& file) {
  const char* format = require_format(file);
  const auto fail = [&](const std::string& why) {
    throw InputError(file.string(), "cannot be read: " + why);
  };
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
  if (!input) fail(OIIO::geterror());
  OIIO::ImageSpec spec;
  if (!input->open(file.string(), spec)) fail(input->geterror());
  const int channels[3] = {spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
  for (int c : channels)
    if (c < 0) fail("it has no channels R, G and B");
  if (spec.depth > 1 || spec.deep) fail("it is not a flat image");

  const auto count = static_cast<size_t>(spec.nchannels);
  Image2D<vec3> image(spec.width, spec.height);
  std::vector<float> pixels(image.size() * count);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()))
    fail(input->geterror());
  for (size_t i = 0; i < image.size(); ++i)
    for (int c = 0; c < 3; ++c) image[i][c] = pixels[i * count + static_cast<size_t>(channels[c])];
  return image;
}

}  // namespace hybray
