// What can be made of disparities: numbers, points, a map, pictures.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "image_files/float_files.h"
#include "image_files/raw_image.h"
#include "vision/cameras/rectification.h"
#include "vision/image.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/elevation_map.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::campaign {

// In pixels; NaN where a filter dropped the pixel.
vision::Image<float> DisparityValues(const vision::DisparityImage& disparities);

// Yellow is near, violet far, over the range that was searched; dropped pixels are black.
image_files::Picture DisparityPicture(const vision::DisparityImage& disparities,
                                      const vision::CorrelatorParams& range);

// The left image beside that picture.
image_files::Picture PairPicture(const vision::GrayImage& left,
                                 const image_files::Picture& disparities);

// The points of all pixels with a disparity above zero, in the cameras' outer frame, with the grey
// of the left image.
std::vector<image_files::ColouredPoint> PointsOf(const vision::DisparityImage& disparities,
                                                 const vision::GrayImage& left,
                                                 const vision::RectifiedPair& cameras);

// A grid over the points, seen against the axis of the outer frame (up or down it) that is nearest
// to the images' upward direction: nobody says which way a camera file's frame stands, and a camera
// on a rover stands nearly upright.
vision::ElevationGrid GridOverPoints(const std::vector<image_files::ColouredPoint>& points,
                                     const vision::RectifiedPair& cameras, double cell_m);

// Heights over the grid's cells; m, NaN where no point is.
vision::Image<float> HeightsOf(const std::vector<image_files::ColouredPoint>& points,
                               const vision::ElevationGrid& grid);

// The middle 98 % of the heights, m; nothing where no height is known.
struct HeightSpan {
  double low_m = 0.0;
  double high_m = 0.0;
};
std::optional<HeightSpan> HeightSpanOf(const vision::Image<float>& heights_m);

// The colour of a height: violet at the lower end of the span, yellow at the upper one.
image_files::Rgb HeightColour(double height_m, const HeightSpan& span);

// These colours over HeightSpanOf; cells without a point are black.
image_files::Picture ElevationPicture(const vision::Image<float>& heights_m);

}  // namespace rockyard::campaign
