// The images that a pair of aligned cameras takes, and what it measures of one point: the stages of
// visual odometry hand these on. Drives and `rockyard vo` give it images. Records depend on every
// bit of MeasureStereo and PairProjection.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "math/pose.h"
#include "vision/cameras/camera_types.h"
#include "vision/cameras/rectification.h"
#include "vision/image.h"
#include "vision/stereo/disparity.h"

namespace rockyard::vision {

// Two images of one moment with aligned rows.
struct AlignedImages {
  GrayImage left;
  GrayImage right;
  // Disparities of the left image, if stereo has matched these images already. Otherwise empty, and
  // the odometer makes them if PlacementParams::source needs them.
  DisparityImage disparities = {};
};

// A point in both eyes, and where it lies (Triangulate; Matthies and Shafer 1987). Weights, fit and
// covariance of a motion rest on the covariances, which nothing checks.
struct StereoMeasurement {
  Pixel left = Pixel::Zero();  // column and row in the left image
  double disparity_px = 0.0;   // column_left - column_right, > 0
  // Of (column, row, disparity), px^2.
  Eigen::Matrix3d covariance_px2 = Eigen::Matrix3d::Identity();
  math::Vector3 p_A = math::Vector3::Zero();                // m, in the outer frame of the cameras
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  // of p_A
  // DisparitySlope (refine_match.h) of the surface. 0: it faces the cameras, or nothing is known.
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  // Root mean square of the difference between the two eyes' windows, grey levels.
  double residual = 0.0;
};

// Returns the measurement of a point at `left_pixel`, whose covariance is `pixel_px2`, from its
// disparity, whose variance is `disparity_px2`, both independent: covariance_m2 = J S J' with
// S = diag(pixel_px2, disparity_px2) and J of Triangulate. Returns nothing where the point is at or
// beyond infinity.
std::optional<StereoMeasurement> MeasureStereo(const RectifiedPair& cameras,
                                               const Pixel& left_pixel,
                                               const Eigen::Matrix2d& pixel_px2,
                                               double disparity_px, double disparity_px2);

// One point at two moments: p_F of the first and p_S of the second, each in the outer frame of the
// cameras as it stood then.
struct PointSeenTwice {
  StereoMeasurement first;
  StereoMeasurement second;
};

using PointsSeenTwice = std::vector<PointSeenTwice>;

// Column and row in the left image and disparity, px.
using PairPixel = Eigen::Vector3d;

// Predicts what an aligned pair measures of a point: the inverse of Triangulate.
//
//   column = H . d / A . d    row = V . d / A . d    disparity = H . b / A . d
//
// with d = p - C_left and b = C_right - C_left (cameras/cahv.h).
class PairProjection {
 public:
  explicit PairProjection(const RectifiedPair& pair)
      : C_(pair.left.C),
        A_(pair.left.A),
        H_(pair.left.H),
        V_(pair.left.V),
        depth_disparity_(pair.left.H.dot(pair.right.C - pair.left.C)) {}

  // Returns nothing where p_A (m, in the cameras' outer frame) is not in front of the cameras.
  // Writes the derivative by p_A, px/m, to `jacobian`, if given.
  std::optional<PairPixel> operator()(const math::Vector3& p_A,
                                      Eigen::Matrix3d* jacobian = nullptr) const {
    constexpr double kNearest_m = 1e-6;
    const math::Vector3 d = p_A - C_;
    const double depth = A_.dot(d);
    if (!(depth > kNearest_m)) return std::nullopt;
    const PairPixel pixel(H_.dot(d) / depth, V_.dot(d) / depth, depth_disparity_ / depth);
    if (jacobian != nullptr) {
      jacobian->row(0) = (H_ - pixel.x() * A_).transpose() / depth;
      jacobian->row(1) = (V_ - pixel.y() * A_).transpose() / depth;
      jacobian->row(2) = -pixel.z() * A_.transpose() / depth;
    }
    return pixel;
  }

  // Returns the depth of a point along the cameras' axis, m.
  double Depth(const math::Vector3& p_A) const { return A_.dot(p_A - C_); }

 private:
  math::Vector3 C_;
  math::Vector3 A_;
  math::Vector3 H_;
  math::Vector3 V_;
  double depth_disparity_;  // depth times disparity, m px
};

}  // namespace rockyard::vision
