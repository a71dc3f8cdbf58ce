#include "core/base/image_io.h"

#include "core/base/check.h"
#include "core/base/error.h"

#include <memory>
#include <string>
#include <system_error>

#include <OpenImageIO/imageio.h>

namespace hybray {

void write_png(const std::filesystem::path& file, int width, int height, std::span<const uint8_t> rgb) {
  HYBRAY_CHECK_EQ(rgb.size(), size_t{3} * static_cast<size_t>(width) * static_cast<size_t>(height));
  std::filesystem::path partial = file;
  partial += ".partial";
  const auto fail = [&](const std::string& why) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw RuntimeError("cannot write " + file.string() + ": " + why);
  };
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png");
  if (!output) fail(OIIO::geterror());
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("png:compressionLevel",
                 3);  // low: quick to write, and nobody keeps these pictures for their size
  if (!output->open(partial.string(), spec)) fail(output->geterror());
  if (!output->write_image(OIIO::TypeDesc::UINT8, rgb.data()) || !output->close()) fail(output->geterror());
  std::error_code error;
  std::filesystem::rename(partial, file, error);
  if (error) fail(error.message());
}

}  // namespace hybray
