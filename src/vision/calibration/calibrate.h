// Cameras from images of targets: start in closed form, least squares, outliers left out,
// covariance (Gennery 2001). For `rockyard calibrate`; no drive calibrates, so that no record
// depends on it. Tests hold the errors of rendered targets to the covariance, so that it has to be
// as large as they are.
#pragma once

#include "core/result.h"
#include "vision/calibration/bundle.h"
#include "vision/cameras/camera_model.h"

namespace rockyard::vision {

// Returns the calibrated cameras. `data` has one or two lists of images of equal length, each image
// with all corners. Frame A is that of the survey; without one it is that of the first camera:
// C = 0, z along its A, x along the part of its H across A. The problems, with path "targets": what
// StartValues refuses, no convergence, or targets that leave the focal length open to more than
// 2 % or the principal point to more than 3 % of the image's width (one standard deviation).
// Outliers are left out in at most 10 rounds. Each takes sigma from the median distance of the
// corners in use, which is 1.1774 sigma. Cost: 20 images of 54 corners by two cameras about 0.1 s.
core::Result<Calibration> Calibrate(const CalibrationData& data,
                                    const CalibrationOptions& options = {});

// Returns a calibrated camera as a model, a Cahv where no distortion was estimated.
CameraModel ModelOf(const Calibration& calibration, std::size_t camera, const ImageSize& size,
                    EstimatedLens lens);

// The covariance of one camera's 18 numbers (bundle.h).
using CameraCovariance = Eigen::Matrix<double, kCameraNumbers, kCameraNumbers>;
// Returns the covariance of one camera out of that of all.
CameraCovariance CovarianceOf(const Calibration& calibration, std::size_t camera);

// Returns the root mean square, px, of the distance by which the image of p_A is predicted wrongly:
// sqrt(trace(J S J')), J the derivative by the 18 numbers, S their covariance. Returns nothing
// where p_A is not imaged.
std::optional<double> PredictedError(const Cahvor& camera, const CameraCovariance& covariance,
                                     const math::Vector3& p_A);

struct Estimate {
  double value = 0.0;
  double sd = 0.0;
};

// Focal lengths |A x H| and |A x V|; the principal point (A . H, A . V).
struct Intrinsics {
  Estimate focal_h_px;
  Estimate focal_v_px;
  Estimate centre_h_px;
  Estimate centre_v_px;
};
Intrinsics IntrinsicsOf(const Cahvor& camera, const CameraCovariance& covariance);

// Returns the distance of the centres of the two cameras, m.
Estimate BaselineOf(const Calibration& calibration);

}  // namespace rockyard::vision
