// Where Calibrate (calibrate.h) starts: cameras without distortion and poses of targets, in closed
// form. No record depends on it: any start serves from which least squares converge. What it
// refuses, Calibrate refuses.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/result.h"
#include "vision/calibration/bundle.h"

namespace rockyard::vision {

// Returns the 3 x 3 matrix M with (u, v, 1) ~ M (x, y, 1) for the corners (u, v) of a board's
// points (x, y): the direct linear transformation on coordinates that are shifted and scaled to a
// size of 1 (Hartley and Zisserman 2004, algorithm 4.2). Requires at least 4 corners, no three of
// four in line.
Eigen::Matrix3d PlaneHomography(const ChessboardParams& board, const CornerImage& corners);

// Returns the focal length f, px, of a camera with square pixels and its axis in the middle of the
// image, so that M = (m1, m2, m3) of each image has m1' w m2 = 0 and m1' w m1 = m2' w m2 with
// w = diag(1 / f^2, 1 / f^2, 1) (Zhang 2000, section 3.1), by least squares. Returns nothing where
// the images leave f open, as boards square to the axis do.
std::optional<double> FocalLength(const std::vector<Eigen::Matrix3d>& homographies,
                                  const Pixel& middle);

// Returns the board's pose in the frame of a camera with that focal length and middle: the columns
// of K^-1 M, the first two replaced by the nearest pair of axes.
math::Transform PoseOfBoard(const Eigen::Matrix3d& homography, double focal_px,
                            const Pixel& middle);

// Returns the linear camera that images points in space (p_A, m) at their pixels: the direct linear
// transformation (Abdel-Aziz and Karara 1971), normalized as in PlaneHomography. Requires at least
// 6 points, not in one plane.
Cahv LinearCamera(const std::vector<math::Vector3>& points_A, const std::vector<Pixel>& pixels);

// Returns cameras and poses to start from, or the problem (path "targets"): without a survey fewer
// than 3 images, or targets in planes within 5 deg of parallel; with one all targets in one plane.
core::Result<BundleState> StartValues(const CalibrationData& data);

}  // namespace rockyard::vision
