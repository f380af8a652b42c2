#include "vision/cylinder/colour_classes.h"

#include <algorithm>

#include "core/check.h"

namespace rockyard::vision {
namespace {

constexpr std::string_view kRatioSource =
    "Matthies 1995 A.3 calls the ranges experimentally determined and does not tell them; chosen "
    "about the surface colours of colour_classes.h";

void VisitRatio(core::FieldVisitor& v, std::string_view name, double& value, std::string_view doc) {
  v.Real(name, value,
         {.doc = doc,
          .min = 0.0,
          .max = 255.0,
          .origin = core::Origin::kAssumed,
          .source = kRatioSource,
          .study_low = 0.0,
          .study_high = 1.5});
}

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

void ColourRatioParams::Visit(core::FieldVisitor& v) {
  v.Choice("over", over,
           {.doc = "the primary that the two others are divided by",
            .origin = core::Origin::kPublished,
            .source = "Matthies 1995 A.3: over red for red and magenta, over blue for blue"});
  VisitRatio(v, "first_low", first_low, "least ratio of the first of the two other primaries");
  VisitRatio(v, "first_high", first_high, "largest ratio of the first of the two other primaries");
  VisitRatio(v, "second_low", second_low, "least ratio of the second of the two other primaries");
  VisitRatio(v, "second_high", second_high,
             "largest ratio of the second of the two other primaries");
  v.Require("first_high", first_high >= first_low, "is below first_low", "give a larger one");
  v.Require("second_high", second_high >= second_low, "is below second_low", "give a larger one");
}

void ColourClassParams::Visit(core::FieldVisitor& v) {
  v.Group("blue", blue, "the class blue");
  v.Group("magenta", magenta, "the class magenta: pink");
  v.Group("red", red, "the third class: orange, or green in its place");
  v.Real("darkest", darkest,
         {.doc = "grey levels of the primary below which a pixel is background",
          .min = 1.0,
          .max = 255.0,
          .origin = core::Origin::kAssumed,
          .source = "not in Matthies 1995; noise of 2 grey levels moves a ratio by 0.1 there",
          .study_low = 5.0,
          .study_high = 40.0});
}

ColourRatioParams GreenRatios() { return {PrimaryColour::kGreen, 0.0, 0.50, 0.0, 0.60}; }

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
