// Where an eye sees the wall and its quadrants (WallSeen), and the colours of the quadrants by
// linear least squares over the eye's profile, with the residuals (FitWallColours). For FitProblem
// (fit_problem.h) at every place that it tries; WallSeen also for boxes and regions to draw.
// Records of the experiment on sightings depend on every sum of it.
//
// A pixel mixes the parts (quadrants and backgrounds) that its column covers, blurred by a normal
// distribution. The wall of a quadrant has the colour
//
//   g_0 + g_1 t + g_2 (sqrt(1 - t^2) - pi / 4)
//
// with t from -1 to 1 across the cylinder, as a Lambertian wall has in diffuse light and in a sun
// from anywhere on its side. The priors of g_1 and g_2 are 0, with shading_sd along the quadrant's
// colour (brightness) and tint_sd across it: a quadrant has one colour, and only the light changes
// between its sides. With the lines given, the problem is linear in the g.
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

// The image of a line of the wall parallel to the axis: through (column, row), with `slope` columns
// a row.
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

// Returns the part of v across an axis of length 1.
inline math::Vector3 AcrossAxis(const math::Vector3& v, const math::Vector3& axis) {
  return v - v.dot(axis) * axis;
}

// Returns where the wall of the cylinder and its quadrants begin and end in the image of an eye.
// The wall that an eye at distance D from the axis sees reaches acos(rho / D), less than 90 deg, to
// either side of the eye's azimuth. Slopes are taken over `height_m` of the wall about the middle.
// Returns nothing where the eye is not outside of the cylinder or a line is not imaged.
std::optional<WallView> WallSeen(const CameraModel& camera, const EyeGeometry& eyes,
                                 const CylinderPlace& place, double height_m);

// A quadrant's colour in the middle of its visible part, grey levels.
struct QuadrantColour {
  int quadrant = 0;
  Eigen::Vector3d colour = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

// Directions of the quadrants' primaries (DirectionOf), A to D.
using QuadrantDirections = std::array<Eigen::Vector3d, 4>;

// Returns the number of residuals of a profile, which is the same for every view: one for each
// primary of each sample, and the priors.
int ResidualsOf(const EyeProfile& profile);

// Returns the colours of the visible quadrants. Appends ResidualsOf(profile) residuals over their
// standard deviations to `residuals`. `blur_px` is the standard deviation of the blur of edges.
std::vector<QuadrantColour> FitWallColours(const EyeProfile& profile, const WallView& view,
                                           const QuadrantDirections& directions, double blur_px,
                                           const CylinderFitParams& params,
                                           std::vector<double>& residuals);

}  // namespace rockyard::vision
