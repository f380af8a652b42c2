// EncodePng (png_file.h), by libpng.
#include <png.h>

#include <stdexcept>

#include "core/check.h"
#include "image_files/png_file.h"

namespace rockyard::image_files {
namespace {

template <typename Value>
std::string Encode(const vision::Image<Value>& picture, png_uint_32 format) {
  EXPECT(!picture.empty());
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width());
  image.height = static_cast<png_uint_32>(picture.height());
  image.format = format;
  const void* pixels = picture.values().data();

  png_alloc_size_t bytes = 0;
  std::string file;
  // The first call says how large the file becomes, the second writes it.
  if (png_image_write_to_memory(&image, nullptr, &bytes, 0, pixels, 0, nullptr) != 0) {
    file.resize(bytes);
    if (png_image_write_to_memory(&image, file.data(), &bytes, 0, pixels, 0, nullptr) != 0) {
      file.resize(bytes);
      return file;
    }
  }
  throw std::runtime_error(std::string("libpng: ") + image.message);
}

}  // namespace

std::string EncodePng(const Picture& picture) {
  static_assert(sizeof(Rgb) == 3, "libpng reads the pixels as they lie");
  return Encode(picture, PNG_FORMAT_RGB);
}

std::string EncodePng(const vision::GrayImage& image) { return Encode(image, PNG_FORMAT_GRAY); }

std::string EncodePng(const SamplePlane& image) { return Encode(image, PNG_FORMAT_LINEAR_Y); }

}  // namespace rockyard::image_files
