#include "image_files/read_image.h"

#include <fmt/format.h>

#include <optional>

#include "core/error.h"
#include "core/files.h"
#include "image_files/float_files.h"
#include "image_files/gdal_raster.h"
#include "image_files/planetary.h"
#include "image_files/png_file.h"
#include "image_files/raw_image.h"

namespace rockyard::image_files {
namespace {

constexpr std::string_view kPngMark = "\x89PNG\r\n\x1a\n";
constexpr std::string_view kJpegMark = "\xff\xd8\xff";

// P and the digit of the type, then white space or a comment.
bool IsPnm(std::string_view bytes) {
  constexpr std::string_view kAfterType = " \t\n\v\f\r#";
  return bytes.size() >= 3 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '7' &&
         kAfterType.find(bytes[2]) != std::string_view::npos;
}

}  // namespace

RawImage DecodeImage(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  if (bytes.empty()) FailUnsupported(name, "is empty", "copy it again, or make it anew");
  if (bytes.starts_with(kPngMark)) return DecodePng(bytes, name, limits);
  if (bytes.starts_with(kJpegMark)) return DecodeJpeg(bytes, name, limits);
  if (IsPnm(bytes)) return DecodePnm(bytes, name, limits);
  if (IsPfm(bytes)) {
    FailUnsupported(name, "is a PFM file, which holds reals rather than an image",
                    "name an image: a PFM file is a reference of disparities");
  }
  FailUnsupported(name, "is of no format of images that is known",
                  "name a PNG, JPEG, PGM, PPM, PDS3, PDS4 or VICAR file");
}

RawImage ReadImage(const std::filesystem::path& path, const ImageLimits& limits) {
  const std::string bytes = core::ReadWholeFile(path, kMaxFileBytes, "an image file");
  if (const std::optional<PlanetaryKind> kind = PlanetaryKindOf(bytes)) {
    return ReadPlanetary(path, bytes, *kind, limits, FindGdal());
  }
  return DecodeImage(bytes, path.string(), limits);
}

std::string DescribeImage(const RawImage& image) {
  return fmt::format("{} x {} pixels of {}-bit {}, {}", image.width(), image.height(), image.bits,
                     image.is_colour() ? "colour" : "grey", image.format);
}

}  // namespace rockyard::image_files
