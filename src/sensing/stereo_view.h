// One rectified pinhole pair, as a rover carries it, and which of its points are handed on. Range
// points, rendered images, the ground truth and the pictures of replays all look along these rays:
// one pixel must mean one direction at every fidelity. Records of all drives by stereo depend on
// the bits of rays.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "math/pose.h"
#include "messages/point_cloud.h"
#include "sensing/stereo_params.h"

namespace rockyard::sensing {

// How the pair looks, in R, or by From in W. Pixel (column, row), counted from the upper left one,
// looks along
//   e(column, row) = first + column along_row + row along_column,
// the pinhole of vision/lens.h with the principal point in the middle of the image, scaled so that
// the part of e along the optical axis is 1: eye + Z e is the point at depth Z. The right eye has
// parallel axes and stands the baseline b along the rows: the same point appears f b / Z columns
// further left in its image.
struct StereoView {
  int columns = 0;
  int rows = 0;
  double focal_px = 0.0;                               // f, along rows
  double baseline_m = 0.0;                             // b; 0: one eye
  math::Vector3 eye = math::Vector3::Zero();           // the left one, to which points belong
  math::Vector3 right_eye = math::Vector3::Zero();     // equal to it where there is one eye
  math::Vector3 first = math::Vector3::UnitX();        // ray of pixel (0, 0)
  math::Vector3 along_row = math::Vector3::Zero();     // from column to column, to the right
  math::Vector3 along_column = math::Vector3::Zero();  // from row to row, downwards

  math::Vector3 Ray(double column, double row) const {
    return first + column * along_row + row * along_column;
  }
  // Returns the same view in W.
  StereoView From(const math::Transform& X_WR) const;
};

// A value for each pixel, [row][column]: one over a depth, 1/m, or a disparity, px; 0 where the
// pixel shows nothing.
using DepthImage = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Returns the view in R. The ideal sensor has one eye in the middle of the pair.
StereoView MakeStereoView(const StereoParams& params, messages::LookDirection direction);

// Returns whether a point of a look, in R, is handed on: always with the full field of view, else
// where it lies in stripe_window, which lies ahead of the rover or behind it as the pair looks.
bool IsWanted(const StereoParams& params, const math::Vector3& p_RoP_R,
              messages::LookDirection direction);

// Returns the points of a look in R that IsWanted, in the order of rows. Each pixel whose inverse
// depth is above 0 has its point at that depth on its ray of `view_R`.
messages::PointCloud PointsOf(const StereoParams& params, const StereoView& view_R,
                              const DepthImage& inverse_depths, std::int64_t look_number,
                              messages::LookDirection direction);

}  // namespace rockyard::sensing
