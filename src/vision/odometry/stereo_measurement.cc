#include "vision/odometry/stereo_measurement.h"

#include "vision/cameras/rectification.h"

namespace rockyard::vision {

std::optional<StereoMeasurement> MeasureStereo(const RectifiedPair& cameras,
                                               const Pixel& left_pixel,
                                               const Eigen::Matrix2d& pixel_px2,
                                               double disparity_px, double disparity_px2) {
  const auto point = Triangulate(cameras.left, cameras.right, left_pixel, disparity_px);
  if (!point) return std::nullopt;
  StereoMeasurement measured;
  measured.left = left_pixel;
  measured.disparity_px = disparity_px;
  measured.covariance_px2.topLeftCorner<2, 2>() = pixel_px2;
  measured.covariance_px2(2, 2) = disparity_px2;
  measured.p_A = point->p_A;
  measured.covariance_m2 = point->Covariance(measured.covariance_px2);
  return measured;
}

}  // namespace rockyard::vision
