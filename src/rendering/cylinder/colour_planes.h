// An image in three channels before it is counted.
#pragma once

#include <array>

#include "rendering/cylinder/colour.h"
#include "vision/image.h"

namespace rockyard::rendering {

using ColourPlane = vision::Image<float>;

// Red, green, blue; all of one size. Radiance times pi (as irradiance of a white surface), or
// counts.
using ColourPlanes = std::array<ColourPlane, 3>;

inline ColourPlanes MakePlanes(int columns, int rows) {
  const ColourPlane plane(columns, rows, 0.0F);
  return {plane, plane, plane};
}

inline void SetPixel(ColourPlanes& planes, int column, int row, const Colour& colour) {
  for (std::size_t i = 0; i < planes.size(); ++i) {
    planes[i].At(column, row) = static_cast<float>(colour[static_cast<Eigen::Index>(i)]);
  }
}

inline Colour PixelOf(const ColourPlanes& planes, int column, int row) {
  return {planes[0].At(column, row), planes[1].At(column, row), planes[2].At(column, row)};
}

}  // namespace rockyard::rendering
