// The wall as an eye sees it, and this view against the eye's profile: the colours of the quadrants
// by linear least squares, and what they leave.
//
// A pixel holds each part that its column covers, blurred by a normal distribution. The wall of a
// quadrant has the colour
//
//   g_0 + g_1 t + g_2 (sqrt(1 - t^2) - pi / 4)
//
// with t from -1 to 1 across the cylinder: what a Lambertian wall shows in diffuse light and in a
// sun from anywhere on its side. g_1 and g_2 are drawn to 0, by shading_sd along the quadrant's
// colour, where they tell brightness, and by tint_sd across it: a quadrant has one colour, and what
// changes between its sides is the light's. Given where the lines are, the g are linear.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "vision/cylinder/cylinder_equations.h"
#include "vision/cylinder/cylinder_profile.h"

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

// Where the wall of the cylinder and its quadrants begin and end in the image of an eye, exactly.
// The wall that an eye at distance D from the axis sees reaches to acos(rho / D) on either side of
// the eye's azimuth, less than half of it; the boundaries between are those of the quadrants.
// Nothing where the eye is not outside of the cylinder or a line is not imaged. `height_m` of the
// wall about the middle tells the slopes.
std::optional<WallView> WallSeen(const CameraModel& camera, const EyeGeometry& eyes,
                                 const CylinderPlace& place, double height_m);

// A quadrant's colour in its middle, grey levels.
struct QuadrantColour {
  int quadrant = 0;
  Eigen::Vector3d colour = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

// Directions of the quadrants' primaries (DirectionOf), A to D.
using QuadrantDirections = std::array<Eigen::Vector3d, 4>;

// The number of residuals of a profile, whatever the view: samples, and shading terms.
int ResidualsOf(const EyeProfile& profile);

// What the quadrants look like. Appends residuals over their standard deviations to `residuals`,
// ResidualsOf of them. `blur_px`: the standard deviation of the blur of edges.
std::vector<QuadrantColour> FitWallColours(const EyeProfile& profile, const WallView& view,
                                           const QuadrantDirections& directions, double blur_px,
                                           const CylinderFitParams& params,
                                           std::vector<double>& residuals);

}  // namespace rockyard::vision
