#include "image_files/planetary.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <string>
#include <utility>

#include "image_files/raw_image.h"

namespace rockyard::image_files {
namespace {

// Bytes at the front of a file that tell the kinds apart; XML takes eight times as many.
constexpr std::size_t kFront = 1024;
// Labels of rover images have some 50 kB.
constexpr std::size_t kLargestLabel = std::size_t{1} << 20;

const char* DriverOf(PlanetaryKind kind) {
  return kind == PlanetaryKind::kPds3 ? "PDS" : NameOf(kind);
}

bool Holds(std::string_view text, std::string_view word) {
  return text.find(word) != std::string_view::npos;
}

// Returns what follows `word`, which is found in upper and lower case.
std::string_view After(std::string_view text, std::string_view word) {
  const auto found = std::search(
      text.begin(), text.end(), word.begin(), word.end(),
      [](unsigned char a, unsigned char b) { return std::toupper(a) == std::toupper(b); });
  if (found == text.end()) return {};
  return text.substr(static_cast<std::size_t>(found - text.begin()) + word.size());
}

// Takes a number from the front of `text`.
std::optional<int> TakeNumber(std::string_view& text, int base) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

}  // namespace

const char* NameOf(PlanetaryKind kind) {
  switch (kind) {
    case PlanetaryKind::kPds3:
      return "PDS3";
    case PlanetaryKind::kPds4:
      return "PDS4";
    case PlanetaryKind::kVicar:
      break;
  }
  return "VICAR";
}

std::optional<PlanetaryKind> PlanetaryKindOf(std::string_view bytes) {
  const std::string_view front = bytes.substr(0, kFront);
  if (front.starts_with("LBLSIZE=")) return PlanetaryKind::kVicar;
  if (Holds(front, "PDS_VERSION_ID") || Holds(front, "ODL_VERSION_ID")) {
    return PlanetaryKind::kPds3;
  }
  const bool is_xml = front.starts_with("<") || front.starts_with("\xef\xbb\xbf<");
  if (is_xml && Holds(bytes.substr(0, 8 * kFront), "pds.nasa.gov/pds4")) {
    return PlanetaryKind::kPds4;
  }
  return std::nullopt;
}

// A number of PDS3's Object Description Language: decimal digits, or a base, # and digits of it.
std::optional<int> SampleBitMask(std::string_view bytes) {
  std::string_view text = After(bytes.substr(0, kLargestLabel), "SAMPLE_BIT_MASK");
  text.remove_prefix(std::min(text.find_first_not_of(" =>'\"\t\r\n"), text.size()));
  constexpr int kDecimal = 10;
  std::optional<int> number = TakeNumber(text, kDecimal);
  if (number && text.starts_with('#')) {
    constexpr int kLargestBase = 16;
    const int base = *number;
    if (base < 2 || base > kLargestBase) return std::nullopt;
    text.remove_prefix(1);
    number = TakeNumber(text, base);
  }
  if (!number || *number < 1 || *number > 65535) return std::nullopt;
  return number;
}

RawImage ReadPlanetary(const std::filesystem::path& path, std::string_view bytes,
                       PlanetaryKind kind, const ImageLimits& limits, const RasterSupport& gdal) {
  if (gdal.reader == nullptr) {
    FailUnsupported(
        path.string(),
        fmt::format("is a {} image, which this rockyard cannot read without GDAL", NameOf(kind)),
        gdal.remedy);
  }
  Raster raster = gdal.reader(std::filesystem::absolute(path), DriverOf(kind), limits);
  RawImage image;
  image.format = NameOf(kind);
  image.planes = std::move(raster.planes);
  image.negative = raster.negative;
  const std::optional<int> mask = SampleBitMask(bytes);
  if (mask && *mask < 1 << raster.bits) {
    image.bits = std::bit_width(static_cast<unsigned>(*mask));
    image.full_scale = *mask;
    image.full_scale_from = "the SAMPLE_BIT_MASK of the label";
  } else {
    image.bits = raster.bits;
    image.full_scale = (1 << raster.bits) - 1;
    image.full_scale_from =
        fmt::format("{} bits of its samples, as the label has no SAMPLE_BIT_MASK", raster.bits);
  }
  return image;
}

}  // namespace rockyard::image_files
