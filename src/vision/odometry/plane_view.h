// How a small surface looks from where a pair of cameras has moved to: VisualOdometer predicts
// features and their windows by it. Records depend on every bit of it: predictions decide which
// features are compared and how windows are warped.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "math/pose.h"
#include "vision/cameras/rectification.h"
#include "vision/odometry/match_features.h"
#include "vision/odometry/stereo_measurement.h"

namespace rockyard::vision {

// The disparity of a plane is linear in the pixels (column, row, 1) of the left image, d = l . m.
// Under a motion X_SF (R, t) its pixels move by the homography (Hartley and Zisserman 2004, section
// 13.1)
//
//   H = M R M^-1 + M s l' / k    s = R C + t - C    k = H . b, depth times disparity
//
// M has the rows H, V, A of the left camera, C is its centre, b the baseline. G = H^-1 takes the
// second image back to the first, and in the second image the plane's disparities are l_S = G' l.
// Scale G so that it takes (q, 1) to (p, 1); let B_xy be the first two rows of its first two
// columns and g their last row. Then the offset o from q is the offset
// (B_xy - p g') o / (1 + g . o) from p.
class PlaneView {
 public:
  PlaneView(const RectifiedPair& pair, const math::Transform& X_SF);

  // Returns the view of the surface about a point of the first pair, with the measurement's slope.
  // Returns nothing where the point is not in front of the cameras at the second moment, where the
  // surface is then seen from its edge (a slope of more than 0.75), or where it becomes more than
  // eight times smaller.
  std::optional<PredictedFeature> operator()(const StereoMeasurement& measured) const;

 private:
  Eigen::Matrix3d turn_;   // M R M^-1
  Eigen::Vector3d shift_;  // M s / k
};

}  // namespace rockyard::vision
