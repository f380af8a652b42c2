// Where a calibration starts: cameras without distortion and poses of targets, in closed form.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/result.h"
#include "vision/calibration/bundle.h"

namespace rockyard::vision {

// The 3 x 3 matrix M with (u, v, 1) ~ M (x, y, 1) for corners (u, v) of a plane's points (x, y):
// the direct linear transformation on coordinates that are shifted and scaled to a size of 1
// (Hartley and Zisserman 2004, algorithm 4.2). At least 4 corners, no three of four in line.
Eigen::Matrix3d PlaneHomography(const ChessboardParams& board, const CornerImage& corners);

// The focal length, px, of a camera with square pixels and its axis in the middle of the image, so
// that M = (m1, m2, m3) of each image has m1' w m2 = 0 and m1' w m1 = m2' w m2 with
// w = diag(1 / f^2, 1 / f^2, 1) (Zhang 2000, section 3.1), by least squares. Nothing where the
// images leave it open: boards square to the axis.
std::optional<double> FocalLength(const std::vector<Eigen::Matrix3d>& homographies,
                                  const Pixel& middle);

// The board's pose in the frame of that camera: columns of K^-1 M, of which the first two become
// the nearest pair of axes.
math::Transform PoseOfBoard(const Eigen::Matrix3d& homography, double focal_px,
                            const Pixel& middle);

// The linear camera of points in space (p_A, m) and their pixels: the direct linear transformation
// (Abdel-Aziz and Karara 1971), normalized as above. At least 6 points, not in one plane.
Cahv LinearCamera(const std::vector<math::Vector3>& points_A, const std::vector<Pixel>& pixels);

// Cameras and poses to start from, or the problem (path "targets"): fewer than 3 images of targets
// whose poses are not known, targets in planes within 5 deg of parallel, or surveyed ones in one
// plane.
core::Result<BundleState> StartValues(const CalibrationData& data);

}  // namespace rockyard::vision
