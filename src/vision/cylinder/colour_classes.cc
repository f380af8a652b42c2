#include "vision/cylinder/colour_classes.h"

#include <algorithm>

#include "core/check.h"

namespace rockyard::vision {
namespace {

// Whether low <= value / over <= high.
bool RatioIn(double value, double over, double low, double high) {
  return value >= low * over && value <= high * over;
}

bool IsOfClass(const Rgb& pixel, const ColourRatioParams& ratios, double darkest) {
  const double red = pixel.red;
  const double green = pixel.green;
  const double blue = pixel.blue;
  double over = red;
  double first = green;
  double second = blue;
  if (ratios.over == PrimaryColour::kGreen) {
    over = green;
    first = red;
  } else if (ratios.over == PrimaryColour::kBlue) {
    over = blue;
    first = red;
    second = green;
  }
  return over >= darkest && RatioIn(first, over, ratios.first_low, ratios.first_high) &&
         RatioIn(second, over, ratios.second_low, ratios.second_high);
}

// Fills columns first to end - 1, which are background.
void FillGap(int first, int end, int row, std::span<std::uint8_t> labels) {
  const std::uint8_t left = labels[static_cast<std::size_t>(first - 1)];
  const std::uint8_t right = labels[static_cast<std::size_t>(end)];
  const int of_left = (end - first + (row % 2 == 0 ? 1 : 0)) / 2;
  for (int x = first; x < end; ++x) {
    labels[static_cast<std::size_t>(x)] = x < first + of_left ? left : right;
  }
}

}  // namespace

std::uint8_t ClassOf(const Rgb& pixel, const ColourClassParams& params) {
  if (IsOfClass(pixel, params.blue, params.darkest)) return LabelOf(CylinderColour::kBlue);
  if (IsOfClass(pixel, params.magenta, params.darkest)) return LabelOf(CylinderColour::kMagenta);
  if (IsOfClass(pixel, params.red, params.darkest)) return LabelOf(CylinderColour::kRed);
  return kBackground;
}

ClassImage ClassifyColours(const ColourImage& image, int first_row,
                           const ColourClassParams& params) {
  EXPECT(first_row >= 0 && first_row <= image.height());
  ClassImage classes(image.width(), image.height(), kBackground);
  for (int y = first_row; y < image.height(); ++y) {
    const std::span<const Rgb> pixels = image.Row(y);
    std::transform(pixels.begin(), pixels.end(), classes.Row(y).begin(),
                   [&](const Rgb& pixel) { return ClassOf(pixel, params); });
  }
  return classes;
}

void FillGaps(int longest, ClassImage& classes) {
  for (int y = 0; y < classes.height(); ++y) {
    const std::span<std::uint8_t> row = classes.Row(y);
    int last = -1;  // the last column that is no background
    for (int x = 0; x < classes.width(); ++x) {
      const std::uint8_t label = row[static_cast<std::size_t>(x)];
      if (label == kBackground) continue;
      const int gap = x - last - 1;
      if (last >= 0 && gap >= 1 && gap <= longest && row[static_cast<std::size_t>(last)] != label) {
        FillGap(last + 1, x, y, row);
      }
      last = x;
    }
  }
}

}  // namespace rockyard::vision
