// Which pixels have the colour of which quadrant, by ratios of their primary colours (Matthies
// 1995, A.3).
#pragma once

#include <cstdint>

#include "vision/colour_image.h"
#include "vision/cylinder/colour_class_params.h"
#include "vision/cylinder/colour_cylinder.h"

namespace rockyard::vision {

// 0 for background, else 1 + the class.
using ClassImage = Image<std::uint8_t>;
inline constexpr std::uint8_t kBackground = 0;
constexpr std::uint8_t LabelOf(CylinderColour colour) {
  return static_cast<std::uint8_t>(1 + static_cast<int>(colour));
}
constexpr CylinderColour ColourOf(std::uint8_t label) {
  return static_cast<CylinderColour>(label - 1);
}

// The class of one pixel. Where ranges of two classes overlap, the first in the order blue,
// magenta, red. A pixel whose primary is darker than `darkest` is background: its ratios are noise.
std::uint8_t ClassOf(const Rgb& pixel, const ColourClassParams& params);

// The classes of rows first_row to the end; background above. 0 <= first_row <= height.
ClassImage ClassifyColours(const ColourImage& image, int first_row,
                           const ColourClassParams& params);

// Fills gaps in place: one to `longest` background pixels between two pixels of different classes
// in a row. The left half of a gap takes the colour on its left, the right half that on its right;
// the middle pixel of an odd one takes the left colour in even rows and the right one in odd rows,
// so that neither side gains.
void FillGaps(int longest, ClassImage& classes);

}  // namespace rockyard::vision
