// Where features lie in space, from a dense disparity map (Goldberg 2002 section 2; Matthies and
// Shafer 1987).
#pragma once

#include <optional>

#include "vision/cameras/rectification.h"
#include "vision/image.h"
#include "vision/odometry/odometer_params.h"
#include "vision/odometry/slanted_match.h"
#include "vision/odometry/stereo_measurement.h"
#include "vision/stereo/disparity.h"

namespace rockyard::vision {

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

}  // namespace rockyard::vision
