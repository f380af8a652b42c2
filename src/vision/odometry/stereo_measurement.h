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

// A point in both eyes, and where it lies (Triangulate; Matthies and Shafer 1987).
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

}  // namespace rockyard::vision
