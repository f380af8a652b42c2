// Colours of curves that stay apart for colour-blind readers (Okabe and Ito 2008).
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace rockyard::report {

inline constexpr std::array<std::string_view, 7> kCurveColours{
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};

// The same colours again after the last.
constexpr std::string_view CurveColour(std::size_t curve) {
  return kCurveColours[curve % kCurveColours.size()];
}

}  // namespace rockyard::report
