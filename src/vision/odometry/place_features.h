// Where features lie in space, for VisualOdometer: from the right eye (Matthies and Shafer 1987),
// or from a dense disparity map (Goldberg 2002 section 2). A doubtful place is dropped, as motions,
// their fits and their covariances rest on places. Records of drives with visual odometry depend on
// every threshold and rounding in here.
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

// The side of windows compared at whole disparities. Odd, so that a window has a middle; with 17
// sums of differences would not fit 16 bits.
inline constexpr int kRowSide = 15;
inline constexpr int kRowReach = kRowSide / 2;

// Writes the sums of absolute differences between the window of 15 x 15 pixels about (column, row)
// of the left image and those about (column - d, row) of the right one, d = first_disparity,
// first_disparity + 1, ..., one for each of `differences`. The windows lie inside. The sums are the
// same on every instruction set. Cost: 0.4 us for 96 with 64 bytes a vector.
void RowDifferences(const GrayImage& left, const GrayImage& right, int column, int row,
                    int first_disparity, std::span<std::uint16_t> differences);

// Finds features of the left image in the right one.
class FeaturePlacer {
 public:
  // `cameras` and the images outlive it.
  FeaturePlacer(const RectifiedPair& cameras, const PlacementParams& params, const GrayImage& left,
                const GrayImage& right)
      : cameras_(cameras), params_(params), left_(left), right_(right) {}

  // Returns the place of a feature at `left_pixel`, whose covariance is `covariance_px2`. The
  // window of 15 x 15 pixels about the nearest pixel is compared with those of its row at all whole
  // disparities from min_disparity_px to max_disparity_px. From the least sum of absolute
  // differences a finer search finds disparity and slope (FindSlanted: ground that is taken to face
  // the cameras makes motions nod) or, with PlacementParams::slanted off, the disparity alone.
  // Returns nothing where fewer than three windows of the right image lie inside, where the best is
  // at an end of the range, where the finer search fails, and where another disparity, more than
  // one pixel off, is nearly as good (PlacementParams::ambiguity).
  std::optional<StereoMeasurement> Place(const Pixel& left_pixel,
                                         const Eigen::Matrix2d& covariance_px2) const;

  // Does what Place does where the slope is known: the finer search is for the disparity alone.
  std::optional<StereoMeasurement> PlaceOn(const DisparitySlope& slope, const Pixel& left_pixel,
                                           const Eigen::Matrix2d& covariance_px2) const;

 private:
  // Returns the column at which the right eye sees a feature, to a whole disparity.
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

// Returns the disparities of the left image's pixels by the pipeline of stereo/stereo.h with the
// parameters of `params.map`, over the range of `params`. Requires images of one size. Cost: 10 ms
// for 512 x 384 pixels and 96 disparities.
DisparityImage MakePlacementMap(const GrayImage& left, const GrayImage& right,
                                const PlacementParams& params);

// Returns the disparity of the map at a place between pixels, by bilinear interpolation of the two
// or four about it, or of one pixel where it lies on it:
//
//   d = sum_i w_i d_i,   w_i = (1 - |x - x_i|) (1 - |y - y_i|)
//
// Returns nothing where one of these pixels lies outside of the map or has no disparity, or where
// two of them are more than `max_step_px` apart: they show two surfaces, and a disparity in between
// belongs to neither.
std::optional<double> DisparityAt(const DisparityImage& map, const Pixel& place,
                                  double max_step_px);

// Returns by how much the disparity grows with column and row about the nearest pixel, from the
// pixels seven to either side. A slope is 0 where one of the three pixels has no disparity, or
// where the middle one lies more than `max_step_px` off the line through the others, as at an edge.
// In a map with a noise of 0.15 px a slope is known to 0.015.
DisparitySlope SlopeAt(const DisparityImage& map, const Pixel& place, double max_step_px);

// Returns the place of a feature at `left_pixel`, whose covariance is `covariance_px2`. The slope
// is that of SlopeAt; the residual is 0, as no windows are compared. The disparity's standard
// deviation is `params.map.noise_px`: neighbours share most of their windows, so that interpolation
// does not lessen it. Returns nothing where DisparityAt does and where the disparity is outside of
// the range of `params`. Left out, as by FeaturePlacer: an error of `left_pixel` adds to the
// disparity by the slope.
std::optional<StereoMeasurement> PlaceInMap(const RectifiedPair& cameras,
                                            const PlacementParams& params,
                                            const DisparityImage& map, const Pixel& left_pixel,
                                            const Eigen::Matrix2d& covariance_px2);

// Returns the points whose windows fit, in their order. A point has residuals of three kinds: of
// the first pair, of the second pair, and `in_time`, between both left images, with one number for
// each point or none at all. The share of a residual is its ratio to the lower quartile of its
// kind, which counts as at least half a grey level. A point is kept where its largest share is at
// most PlacementParams::max_residual_ratio, or among the `min_kept` smallest. Windows across a
// rock's edge fit no plane, and the background in them biases all of them to one side.
PointsSeenTwice KeepClean(const PointsSeenTwice& points, std::span<const double> in_time,
                          const PlacementParams& params);

// Finds places of features of one pair of images by the source that PlacementParams name.
class FeaturePlaces {
 public:
  // All arguments must outlive it. `images` have disparities if these are the source.
  FeaturePlaces(const RectifiedPair& cameras, const PlacementParams& params,
                const AlignedImages& images)
      : cameras_(cameras),
        params_(params),
        images_(images),
        right_eye_(cameras, params, images.left, images.right) {}

  // Place and PlaceOn are those of FeaturePlacer, or PlaceInMap, which takes slopes from the map.
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
