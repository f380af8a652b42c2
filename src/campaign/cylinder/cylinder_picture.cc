#include "campaign/cylinder/cylinder_picture.h"

#include <algorithm>
#include <cstddef>

#include "campaign/looks/picture_lines.h"

namespace rockyard::campaign {
namespace {

using image_files::Picture;
using image_files::Rgb;

Rgb BoxColour(const vision::ColourRegion& region) {
  if (!region.colour) return {255, 255, 255};
  switch (*region.colour) {
    case vision::CylinderColour::kBlue:
      return {0, 255, 255};
    case vision::CylinderColour::kMagenta:
      return {255, 0, 255};
    case vision::CylinderColour::kRed:
      return {255, 255, 0};
  }
  return {255, 255, 255};
}

void CopyInto(const vision::ColourImage& image, int first_column, Picture& picture) {
  for (int y = 0; y < image.height(); ++y) {
    const auto row = image.Row(y);
    std::copy(row.begin(), row.end(), picture.Row(y).begin() + first_column);
  }
}

// The box around a region, one pixel outside of it.
void DrawBox(const vision::ColourRegion& region, int first_column, Picture& picture) {
  const double left = first_column + region.left - 1.0;
  const double right = first_column + region.right + 1.0;
  const double top = region.top - 1.0;
  const double bottom = region.bottom + 1.0;
  const Rgb colour = BoxColour(region);
  DrawLine({{left, top}, {right, top}}, colour, 1, picture);
  DrawLine({{left, bottom}, {right, bottom}}, colour, 1, picture);
  DrawLine({{left, top}, {left, bottom}}, colour, 1, picture);
  DrawLine({{right, top}, {right, bottom}}, colour, 1, picture);
}

}  // namespace

Picture CylinderPicture(const vision::ColourImage& left, const vision::ColourImage& right,
                        const vision::CylinderFinding& finding) {
  Picture picture(left.width() + right.width(), std::max(left.height(), right.height()));
  CopyInto(left, 0, picture);
  CopyInto(right, left.width(), picture);
  if (!finding.sighting) return picture;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const int first_column = eye == 0 ? 0 : left.width();
    const auto& regions = finding.sighting->regions.at(eye);
    // Quadrants first, so that the whole stays visible about them.
    for (std::size_t i = regions.size(); i > 0; --i) {
      DrawBox(regions[i - 1], first_column, picture);
    }
  }
  return picture;
}

}  // namespace rockyard::campaign
