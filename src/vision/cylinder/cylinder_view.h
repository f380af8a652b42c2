// Where the wall of the cylinder and its quadrants begin and end in the image of an eye, exactly.
//
// The wall that an eye at distance D from the axis sees reaches to acos(rho / D) on either side of
// the eye's azimuth, less than half of it; the boundaries between are those of the quadrants.
#pragma once

#include <optional>
#include <vector>

#include "vision/cylinder/sight_lines.h"

namespace rockyard::vision {

// A cylinder that stands along a given axis but for a small roll.
struct CylinderPlace {
  math::Vector3 p_LT_L = math::Vector3::Zero();   // m
  math::Vector3 axis_L = math::Vector3::UnitZ();  // of length 1
  double orientation_rad = 0.0;                   // azimuth of the middle between the eyes in T
  double roll_rad = 0.0;                          // of its axis to the right of the image
  double radius_m = 0.0;
};

// A line of the wall, as column = column + slope (row - row) in the image.
struct WallLine {
  double column = 0.0;
  double row = 0.0;
  double slope = 0.0;

  double ColumnAt(double at_row) const { return column + slope * (at_row - row); }
};

struct WallView {
  std::vector<WallLine> lines;  // from left to right, rims included: one more than quadrants
  std::vector<int> quadrants;   // 0 to 3 for A to D, from left to right
};

// The part of v across an axis of length 1.
inline math::Vector3 AcrossAxis(const math::Vector3& v, const math::Vector3& axis) {
  return v - v.dot(axis) * axis;
}

// What an eye sees. Nothing where the eye is not outside of the cylinder or a line is not imaged.
// `height_m` of the wall about the middle tells the slopes.
std::optional<WallView> WallSeen(const CameraModel& camera, const EyeGeometry& eyes,
                                 const CylinderPlace& place, double height_m);

}  // namespace rockyard::vision
