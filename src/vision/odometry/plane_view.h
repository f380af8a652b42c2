// How a small surface looks from where a pair of cameras has moved to.
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
// M has the rows H, V, A of the left camera. Its inverse G brings the second image back to the
// first, and the plane's disparities there are l_S = G' l. With G (q, 1) scaled to (p, 1), its
// first two columns B scaled alike, and b their last row, the offset o from q is (B_xy - p b') o /
// (1 + b . o) from p.
class PlaneView {
 public:
  PlaneView(const RectifiedPair& pair, const math::Transform& X_SF);

  // Of the surface about a point of the first pair, which has the measurement's slope. Nothing
  // where it is not in front of the cameras at both moments, where it is seen from its edge at the
  // second (a slope of more than 0.75), and where it becomes more than eight times smaller.
  std::optional<PredictedFeature> operator()(const StereoMeasurement& measured) const;

 private:
  Eigen::Matrix3d turn_;   // M R M^-1
  Eigen::Vector3d shift_;  // M s / k
};

}  // namespace rockyard::vision
