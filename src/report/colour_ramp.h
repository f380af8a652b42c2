// A sequential colour ramp that keeps its order for colour-blind readers and in grey print, and
// colours of curves that stay apart for colour-blind readers (Okabe and Ito 2008).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "image_files/raw_image.h"

namespace rockyard::report {

// Dark violet at 0, green-blue in the middle, yellow at 1; shares beyond are clamped. Luminance
// grows all the way.
image_files::Rgb RampColour(double share);

// The colour of a goodness or certainty: 0 to 255.
image_files::Rgb ByteColour(std::uint8_t value);

inline constexpr std::array<std::string_view, 7> kCurveColours{
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};

// The same colours again after the last.
constexpr std::string_view CurveColour(std::size_t curve) {
  return kCurveColours[curve % kCurveColours.size()];
}

}  // namespace rockyard::report
