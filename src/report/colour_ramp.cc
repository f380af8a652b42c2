#include "report/colour_ramp.h"

#include <algorithm>
#include <cmath>

namespace rockyard::report {
namespace {

// Support colours of ramps of this kind (dark violet, blue, blue-green, green, yellow), evenly
// spaced.
constexpr std::array<image_files::Rgb, 5> kSupport{
    {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};

std::uint8_t Mix(std::uint8_t from, std::uint8_t to, double share) {
  return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
}

}  // namespace

image_files::Rgb RampColour(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * (kSupport.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kSupport.size() - 2);
  const double rest = place - static_cast<double>(below);
  const image_files::Rgb& a = kSupport[below];
  const image_files::Rgb& b = kSupport[below + 1];
  return {Mix(a.red, b.red, rest), Mix(a.green, b.green, rest), Mix(a.blue, b.blue, rest)};
}

image_files::Rgb ByteColour(std::uint8_t value) { return RampColour(value / 255.0); }

}  // namespace rockyard::report
