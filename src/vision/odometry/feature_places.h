// Places of the features of one pair of images, by the source that the parameters name.
#pragma once

#include <optional>

#include "vision/odometry/aligned_images.h"
#include "vision/odometry/map_places.h"
#include "vision/odometry/place_features.h"

namespace rockyard::vision {

class FeaturePlaces {
 public:
  // All of them outlive it. `images` have disparities where places are taken from these.
  FeaturePlaces(const RectifiedPair& cameras, const PlacementParams& params,
                const AlignedImages& images)
      : cameras_(cameras),
        params_(params),
        images_(images),
        right_eye_(cameras, params, images.left, images.right) {}

  // As FeaturePlacer's or PlaceInMap, which has its slope from the map.
  std::optional<StereoMeasurement> Place(const Pixel& left_pixel,
                                         const Eigen::Matrix2d& covariance_px2) const {
    return params_.source == PlaceSource::kDisparityMap
               ? PlaceInMap(cameras_, params_, images_.disparities, left_pixel, covariance_px2)
               : right_eye_.Place(left_pixel, covariance_px2);
  }

  std::optional<StereoMeasurement> PlaceOn(const DisparitySlope& slope, const Pixel& left_pixel,
                                           const Eigen::Matrix2d& covariance_px2) const {
    return params_.source == PlaceSource::kDisparityMap
               ? Place(left_pixel, covariance_px2)
               : right_eye_.PlaceOn(slope, left_pixel, covariance_px2);
  }

 private:
  const RectifiedPair& cameras_;
  const PlacementParams& params_;
  const AlignedImages& images_;
  FeaturePlacer right_eye_;
};

}  // namespace rockyard::vision
