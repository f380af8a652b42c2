// A view of the wall against an eye's profile: the colours of the quadrants by linear least
// squares, and what they leave.
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
#include <vector>

#include "vision/cylinder/cylinder_profile.h"
#include "vision/cylinder/cylinder_view.h"

namespace rockyard::vision {

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
