#include "report/png_file.h"

#include <png.h>

#include <stdexcept>

#include "core/check.h"

namespace rockyard::report {

Picture::Picture(int width, int height) : width_(width), height_(height) {
  EXPECT(width >= 1 && height >= 1);
  pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

std::string EncodePng(const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width());
  image.height = static_cast<png_uint_32>(picture.height());
  image.format = PNG_FORMAT_RGB;
  static_assert(sizeof(Rgb) == 3, "libpng reads the pixels as they lie");
  const void* pixels = &picture.At(0, 0);

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

}  // namespace rockyard::report
