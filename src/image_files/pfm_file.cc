#include "image_files/pfm_file.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/check.h"
#include "image_files/header_text.h"
#include "image_files/image_errors.h"

namespace rockyard::image_files {
namespace {

constexpr std::int64_t kMostOfSide = 1'000'000'000;
constexpr std::size_t kBytesAValue = 4;

// Negative: little-endian.
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

}  // namespace rockyard::image_files
