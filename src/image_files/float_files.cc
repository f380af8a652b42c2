#include "image_files/float_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "core/check.h"
#include "core/files.h"
#include "image_files/header_text.h"
#include "image_files/raw_image.h"
#include "image_files/read_image.h"

namespace rockyard::image_files {
namespace {

// The product of two sides does not overflow.
constexpr std::int64_t kMostOfSide = 1'000'000'000;
constexpr std::size_t kBytesAValue = 4;

// Returns the scale of the header; a negative one means little-endian.
double ReadScale(HeaderText& text, const std::string& name) {
  const std::string_view word = text.Word();
  double scale = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), scale);
  const bool read = error == std::errc() && end == word.data() + word.size();
  if (!read || !std::isfinite(scale) || scale == 0.0) {
    FailDamaged(name, "its scale is no number other than 0");
  }
  return scale;
}

float FloatAt(std::string_view bytes, std::size_t at, bool little_endian) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < kBytesAValue; ++i) {
    const std::size_t place = little_endian ? kBytesAValue - 1 - i : i;
    word = word << 8 | static_cast<unsigned char>(bytes[at + place]);
  }
  return std::bit_cast<float>(word);
}

}  // namespace

std::string EncodePfm(const vision::Image<float>& image) {
  EXPECT(!image.empty());
  std::string file = fmt::format("Pf\n{} {}\n-1.0\n", image.width(), image.height());
  file.reserve(file.size() + kBytesAValue * image.values().size());
  for (int y = image.height() - 1; y >= 0; --y) {
    for (const float value : image.Row(y)) {
      AppendLittleEndian(std::isfinite(value) ? value : std::numeric_limits<float>::infinity(),
                         file);
    }
  }
  return file;
}

vision::Image<float> DecodePfm(std::string_view bytes, const std::string& name,
                               const ImageLimits& limits) {
  HeaderText text(bytes, name);
  if (text.Word() != "Pf") {
    FailUnsupported(name, "is a PFM file of three channels", "name one of a single channel (Pf)");
  }
  const std::int64_t width = text.Number("width", kMostOfSide);
  const std::int64_t height = text.Number("height", kMostOfSide);
  const bool little_endian = ReadScale(text, name) < 0.0;
  text.EndOfHeader();
  CheckSize(name, width, height, limits);
  const std::string_view values = text.rest();
  const std::size_t wanted = kBytesAValue * static_cast<std::size_t>(width * height);
  if (values.size() < wanted) FailTruncated(name);
  if (values.size() > wanted) {
    FailDamaged(name, "it goes on after the last pixel that its header speaks of");
  }
  vision::Image<float> image(static_cast<int>(width), static_cast<int>(height));
  std::size_t at = 0;
  for (int y = image.height() - 1; y >= 0; --y) {
    for (float& value : image.Row(y)) {
      const float read = FloatAt(values, at, little_endian);
      value = std::isfinite(read) ? read : std::numeric_limits<float>::quiet_NaN();
      at += kBytesAValue;
    }
  }
  return image;
}

namespace {

bool CanBeWritten(const ColouredPoint& point) { return point.position.cast<float>().allFinite(); }

}  // namespace

std::string EncodePly(std::span<const ColouredPoint> points, std::string_view comment) {
  EXPECT(comment.find_first_of("\n\r") == std::string_view::npos);
  constexpr std::size_t kBytesAPoint = 15;
  std::string file = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment {}\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
      comment, std::count_if(points.begin(), points.end(), CanBeWritten));
  file.reserve(file.size() + kBytesAPoint * points.size());
  for (const ColouredPoint& point : points) {
    if (!CanBeWritten(point)) continue;
    for (const double coordinate : point.position) {
      AppendLittleEndian(static_cast<float>(coordinate), file);
    }
    for (const std::uint8_t channel : {point.colour.red, point.colour.green, point.colour.blue}) {
      file += static_cast<char>(channel);
    }
  }
  return file;
}

namespace {

vision::Image<float> Scaled(const SamplePlane& samples, double samples_a_pixel) {
  vision::Image<float> disparity(samples.width(), samples.height(),
                                 std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < samples.values().size(); ++i) {
    const std::uint16_t sample = samples.values()[i];
    if (sample != 0) disparity.values()[i] = static_cast<float>(sample / samples_a_pixel);
  }
  return disparity;
}

}  // namespace

vision::Image<float> ReadDisparity(const std::filesystem::path& path, double samples_a_pixel,
                                   const ImageLimits& limits) {
  EXPECT(samples_a_pixel > 0.0 && std::isfinite(samples_a_pixel));
  const std::string name = path.string();
  const std::string bytes = core::ReadWholeFile(path, kMaxFileBytes, "a file of disparities");
  if (IsPfm(bytes)) {
    if (samples_a_pixel != 1.0) {
      FailUnsupported(name, "is a PFM file, which holds disparities in pixels",
                      "leave --reference-samples out");
    }
    return DecodePfm(bytes, name, limits);
  }
  const RawImage image = DecodeImage(bytes, name, limits);
  if (image.format == "JPEG") {
    FailUnsupported(name, "is a JPEG file, whose samples are not exact", "name a PFM or PNG file");
  }
  for (const SamplePlane& plane : image.planes) {
    if (plane != image.planes.front()) {
      FailUnsupported(name, "is in colour, which states no disparity", "name a PFM or PNG file");
    }
  }
  return Scaled(image.planes.front(), samples_a_pixel);
}

}  // namespace rockyard::image_files
