// Which pixels have the colour of which quadrant, by ratios of their primary colours, and
// four-connected regions of these classes (Matthies 1995, A.3, by "local blob coloring", Ballard
// and Brown 1982). The published finder classifies by it; both finders take gaps and regions from
// it. Records of the experiment on sightings depend on the regions, their order and ties of their
// sizes; no drive does.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vision/cylinder/colour_cylinder.h"
#include "vision/cylinder/cylinder_sighting.h"
#include "vision/cylinder/published_finder_params.h"
#include "vision/image.h"

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

// Returns the label of one pixel. Where ranges of classes overlap, the first in the order blue,
// magenta, red counts. A pixel does not belong to a class over whose primary it is darker than
// `darkest`, as its ratios are noise.
std::uint8_t ClassOf(const Rgb& pixel, const ColourClassParams& params);

// Returns the labels of rows first_row to the end; background above. 0 <= first_row <= height.
ClassImage ClassifyColours(const ColourImage& image, int first_row,
                           const ColourClassParams& params);

// Fills gaps in place: one to `longest` background pixels between two pixels of different classes
// in a row. The left half of a gap takes the class on its left, the right half that on its right.
// The middle pixel of an odd gap takes the left class in even rows and the right one in odd rows,
// so that neither side gains.
void FillGaps(int longest, ClassImage& classes);

enum class RegionColours {
  kAny,     // any mixture of the classes
  kSingle,  // pixels of one class
};

// A part of an image, ends inclusive, not empty and inside of it.
struct ImagePart {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
};

// Returns the whole of an image, which is not empty.
ImagePart WholeOf(const ClassImage& classes);

// Returns the regions within the part, in the order of their first pixels, row by row. Cost: 0.4 ms
// for 512 x 480 pixels.
std::vector<ColourRegion> FindRegions(const ClassImage& classes, const ImagePart& part,
                                      RegionColours colours);

// Returns the region of the most pixels, the first of several, or nothing for an empty list.
std::optional<ColourRegion> LargestOf(const std::vector<ColourRegion>& regions);

}  // namespace rockyard::vision
