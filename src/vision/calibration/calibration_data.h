// What a calibration starts from and what it gives.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "vision/calibration/camera_parameters.h"
#include "vision/calibration/chessboard_params.h"
#include "vision/cameras/camera_types.h"

namespace rockyard::vision {

// The corners of one image, in the order of CornerPosition.
using CornerImage = std::vector<Pixel>;

struct CalibrationData {
  ChessboardParams board;
  ImageSize size;
  // By camera (one, or left and right of a pair), by image: image i of both shows the same target.
  std::vector<std::vector<CornerImage>> corners;
  // X_AT of each image's target, where it was surveyed; empty: poses are estimated too.
  std::vector<math::Transform> surveyed_X_AT;
};

struct CalibrationOptions {
  EstimatedLens lens = EstimatedLens::kCahvor;
  // How far the optical axis O is expected to lie from the normal A of the image plane, rad, a
  // standard deviation of either direction: what is known of O where distortion is too small to
  // tell. Assumed, > 0; lenses of rovers have 0.001 to 0.01.
  double axis_sd_rad = 0.02;
  // A corner is an outlier further than so many standard deviations from its place. Of 3000 good
  // ones 1 % of the calibrations lose one.
  double outlier_sds = 5.0;
};

struct CornerResidual {
  std::size_t camera = 0;
  std::size_t image = 0;
  std::size_t corner = 0;
  Pixel residual_px = Pixel::Zero();  // measured less predicted
};

struct Calibration {
  std::vector<Cahvor> cameras;        // told in A
  std::vector<math::Transform> X_AT;  // poses of the targets
  // Of the 18 numbers of each camera, one camera after the other (2 x 18 for a pair). Its rank is
  // the number of what is estimated.
  Eigen::MatrixXd covariance;
  double sigma_px = 0.0;  // of a coordinate of a corner: sqrt(sum of squares / degrees of freedom)
  double rms_px = 0.0;    // of the distance from a corner to its prediction
  std::int64_t corners = 0;  // that were used, over all images
  std::int64_t degrees_of_freedom = 0;
  std::vector<CornerResidual> residuals;  // of the corners that were used
  std::vector<CornerResidual> outliers;   // that were not
};

}  // namespace rockyard::vision
