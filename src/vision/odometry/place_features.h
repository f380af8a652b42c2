// Where features lie in space, from the right eye (Matthies and Shafer 1987).
#pragma once

#include <optional>

#include "vision/cameras/rectification.h"
#include "vision/image.h"
#include "vision/odometry/odometer_params.h"
#include "vision/odometry/slanted_match.h"
#include "vision/odometry/stereo_measurement.h"

namespace rockyard::vision {

// Finds places in the left image, of any fraction of a pixel, in the right one.
class FeaturePlacer {
 public:
  // `cameras` and the images outlive it.
  FeaturePlacer(const RectifiedPair& cameras, const PlacementParams& params, const GrayImage& left,
                const GrayImage& right)
      : cameras_(cameras), params_(params), left_(left), right_(right) {}

  // The window of 15 x 15 pixels about the nearest pixel is compared with those of its row at all
  // whole disparities from min_disparity_px to max_disparity_px; the least sum of absolute
  // differences begins the search between pixels, of disparity and slope (slanted_match.h) or, if
  // PlacementParams::slanted is off, of the disparity alone. `covariance_px2` is that of the place
  // in the left image. Nothing where no window of the right image lies inside, where the best is at
  // an end of the range, where the finer search fails, and where another disparity, more than one
  // pixel off, is nearly as good (`ambiguity` of the params).
  std::optional<StereoMeasurement> Place(const Pixel& left_pixel,
                                         const Eigen::Matrix2d& covariance_px2) const;

  // The same where the slope is known: the search is of the disparity alone.
  std::optional<StereoMeasurement> PlaceOn(const DisparitySlope& slope, const Pixel& left_pixel,
                                           const Eigen::Matrix2d& covariance_px2) const;

 private:
  // Where the right eye sees it, to a whole disparity.
  std::optional<double> WholeColumn(const Pixel& left_pixel) const;
  std::optional<SlantedPlace> FindOn(const DisparitySlope& slope, const Pixel& left_pixel,
                                     double column) const;
  std::optional<StereoMeasurement> Measured(const Pixel& left_pixel,
                                            const Eigen::Matrix2d& covariance_px2,
                                            const SlantedPlace& right) const;

  const RectifiedPair& cameras_;
  const PlacementParams& params_;
  const GrayImage& left_;
  const GrayImage& right_;
};

}  // namespace rockyard::vision
