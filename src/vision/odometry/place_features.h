// Where features lie in space: from the right eye (Matthies and Shafer 1987), or from a dense
// disparity map (Goldberg 2002 section 2). Rather no place than a wrong one: motions, their fits
// and their covariances rest on these, so that another threshold or rounding changes records of
// drives with visual odometry.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "vision/cameras/rectification.h"
#include "vision/image.h"
#include "vision/odometry/odometer_params.h"
#include "vision/odometry/refine_match.h"
#include "vision/odometry/stereo_measurement.h"
#include "vision/stereo/disparity.h"

namespace rockyard::vision {

// Odd, so that a window has a middle. From 17 on sums of differences would not fit 16 bits.
inline constexpr int kRowSide = 15;
inline constexpr int kRowReach = kRowSide / 2;

// Sums of absolute differences of the window of 15 x 15 pixels about (column, row) of the left
// image to those about (column - d, row) of the right one, d = first_disparity, first_disparity +
// 1, ..., one for each of `differences`. The windows lie inside. Cost: 0.4 us for 96 with 64 bytes
// a vector.
void RowDifferences(const GrayImage& left, const GrayImage& right, int column, int row,
                    int first_disparity, std::span<std::uint16_t> differences);

// Finds places in the left image, of any fraction of a pixel, in the right one.
class FeaturePlacer {
 public:
  // `cameras` and the images outlive it.
  FeaturePlacer(const RectifiedPair& cameras, const PlacementParams& params, const GrayImage& left,
                const GrayImage& right)
      : cameras_(cameras), params_(params), left_(left), right_(right) {}

  // The window of 15 x 15 pixels about the nearest pixel is compared with those of its row at all
  // whole disparities from min_disparity_px to max_disparity_px; the least sum of absolute
  // differences begins the search between pixels, of disparity and slope (FindSlanted: ground does
  // not face the cameras, and taken as if it did it makes motions nod) or, if
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

// Returns the disparities of the left image's pixels by the pipeline of stereo.h with the
// parameters of `params.map`, over the range of `params`. Images of one size. Cost: 10 ms for 512 x
// 384 pixels and 96 disparities.
DisparityImage MakePlacementMap(const GrayImage& left, const GrayImage& right,
                                const PlacementParams& params);

// Returns the disparity of the map at a place between pixels, by bilinear interpolation of the two
// or four about it, or of one pixel where it lies on it:
//
//   d = sum_i w_i d_i,   w_i = (1 - |x - x_i|) (1 - |y - y_i|)
//
// Nothing where one that counts lies outside of the map or has no disparity, or where two of them
// are more than `max_step_px` apart: they show two surfaces, and what lies between shows neither.
std::optional<double> DisparityAt(const DisparityImage& map, const Pixel& place,
                                  double max_step_px);

// Returns by how much the disparity grows with column and row about the nearest pixel, from those
// seven pixels to either side; 0 along a direction in which one of the three has no disparity, or
// lies more than `max_step_px` off a straight line: an edge or no surface. A slope of a map of 0.15
// px is known to 0.015.
DisparitySlope SlopeAt(const DisparityImage& map, const Pixel& place, double max_step_px);

// Returns the place of a feature of the left image, of any fraction of a pixel. `covariance_px2` is
// that of the place in the left image. The slope is SlopeAt's, the residual 0: there is no window
// of its own. The disparity's standard deviation is `params.map.noise_px`:
// neighbours share most of their windows, so that interpolation lessens it by nothing. Nothing
// where DisparityAt has none and where the disparity is outside of the range of `params`. What an
// error of the place adds to the disparity by the slope of the map is left out, as it is by
// FeaturePlacer.
std::optional<StereoMeasurement> PlaceInMap(const RectifiedPair& cameras,
                                            const PlacementParams& params,
                                            const DisparityImage& map, const Pixel& left_pixel,
                                            const Eigen::Matrix2d& covariance_px2);

// Points whose windows fit: each of their residuals (of either pair of eyes, and `in_time`, between
// both left images, one for each point or none at all) is at most
// PlacementParams::max_residual_ratio times the lower quartile of its kind, or their largest share
// of that is among the `min_kept` smallest. Windows across a rock's edge do not fit any plane, and
// what they show of the background biases them all to one side. A quartile of less than half a grey
// level counts as that. In the points' order.
PointsSeenTwice KeepClean(const PointsSeenTwice& points, std::span<const double> in_time,
                          const PlacementParams& params);

// Places of the features of one pair of images, by the source that the parameters name.
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
