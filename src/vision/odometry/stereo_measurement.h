// What a pair of aligned cameras takes, and what it measures of one point.
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
  // Of the left image's pixels, where stereo has matched these images already; else empty, and made
  // where places are taken from it (PlacementParams::source).
  DisparityImage disparities = {};
};

// A point in both eyes, and where it lies (Triangulate; Matthies and Shafer 1987). Its covariances
// are taken at their word: weights, fit and covariance of a motion rest on them.
struct StereoMeasurement {
  Pixel left = Pixel::Zero();  // column and row in the left image
  double disparity_px = 0.0;   // column_left - column_right, > 0
  // Of (column, row, disparity), px^2.
  Eigen::Matrix3d covariance_px2 = Eigen::Matrix3d::Identity();
  math::Vector3 p_A = math::Vector3::Zero();                // m, in the outer frame of the cameras
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  // of p_A
  // By how much the disparity grows with column and row, where the surface was looked at: a plane's
  // is linear in both. 0: it faces the cameras.
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  // What the two eyes' windows differ by, root mean square, grey levels.
  double residual = 0.0;
};

// Returns what a pair measures of a point at `left_pixel`, whose covariance is `pixel_px2`, with
// the disparity and its variance, independent of that: P = J S J' with S = diag(pixel_px2,
// disparity_px2) and J of Triangulate. Nothing where the point is at or beyond infinity.
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

// What an aligned pair measures of a point: column, row and disparity, with their derivative.
//
//   column = H . d / A . d    row = V . d / A . d    disparity = H . b / A . d
//
// with d = p - C_left and b = C_right - C_left (cahv.h, Triangulate, whose inverse it is).

// Column and row in the left image and disparity, px.
using PairPixel = Eigen::Vector3d;

class PairProjection {
 public:
  explicit PairProjection(const RectifiedPair& pair)
      : C_(pair.left.C),
        A_(pair.left.A),
        H_(pair.left.H),
        V_(pair.left.V),
        depth_disparity_(pair.left.H.dot(pair.right.C - pair.left.C)) {}

  // Nothing where p_A (m, in the cameras' outer frame) is not in front of them. Into `jacobian`,
  // where there is one, the derivative by p_A, px/m.
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

  // Of a point along the cameras' axis, m.
  double Depth(const math::Vector3& p_A) const { return A_.dot(p_A - C_); }

 private:
  math::Vector3 C_;
  math::Vector3 A_;
  math::Vector3 H_;
  math::Vector3 V_;
  double depth_disparity_;  // depth times disparity, m px
};

}  // namespace rockyard::vision
