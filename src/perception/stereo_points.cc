#include "perception/stereo_points.h"

#include <cmath>
#include <cstdint>

#include "vision/cameras/rectification.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo.h"

namespace rockyard::perception {
namespace {

// Returns the pipeline with whole disparities from `search`, and one more on either side for the
// peak filter. sensing/stereo_params.cc bounds max_disparity_px so that they are no more than the
// correlator takes.
vision::StereoPipelineParams PipelineOf(const StereoMatchingParams& params,
                                        const StereoSearch& search) {
  vision::StereoPipelineParams pipeline;
  pipeline.pyramid_level = search.pyramid_level;
  pipeline.dog = params.dog;
  pipeline.filters = params.filters;
  pipeline.correlator.window_side_px = params.window_side_px;
  const auto first = static_cast<std::int64_t>(std::floor(search.min_disparity_px)) - 1;
  const auto last = static_cast<std::int64_t>(std::ceil(search.max_disparity_px)) + 1;
  pipeline.correlator.min_disparity_px = first;
  pipeline.correlator.disparities = last - first + 1;
  return pipeline;
}

}  // namespace

StereoPoints::StereoPoints(const StereoMatchingParams& params, const StereoSearch& search,
                           const vision::StereoRig& rig)
    : params_(PipelineOf(params, search)), search_(search), eyes_(rig, search.pyramid_level) {}

void StereoPoints::DropOutOfRange(vision::DisparityImage& disparities) const {
  for (std::int16_t& disparity : disparities.values()) {
    if (!vision::IsValid(disparity)) continue;
    const double px = vision::DisparityPx(disparity);
    if (px < search_.min_disparity_px || px > search_.max_disparity_px) {
      disparity = vision::Dropped(vision::Drop::kRangeEnd);
    }
  }
}

std::vector<math::Vector3> StereoPoints::PointsOf(const vision::DisparityImage& disparities) const {
  std::vector<math::Vector3> points_R;
  for (int y = 0; y < disparities.height(); ++y) {
    for (int x = 0; x < disparities.width(); ++x) {
      const std::int16_t disparity = disparities.At(x, y);
      if (!vision::IsValid(disparity)) continue;
      const auto point = vision::Triangulate(pair().left, pair().right, vision::Pixel(x, y),
                                             vision::DisparityPx(disparity));
      if (point && (point->p_A - pair().left.C).norm() <= search_.max_range_m) {
        points_R.push_back(point->p_A);
      }
    }
  }
  return points_R;
}

StereoSight StereoPoints::See(const vision::GrayImage& left, const vision::GrayImage& right) const {
  StereoSight sight;
  sight.left = eyes_.Left(left);
  sight.disparities = vision::MatchStereo(sight.left, eyes_.Right(right), params_);
  vision::DropOutside(eyes_.left_free(), eyes_.right_free(),
                      static_cast<int>(params_.correlator.window_side_px), sight.disparities);
  DropOutOfRange(sight.disparities);
  sight.points_R = PointsOf(sight.disparities);
  return sight;
}

}  // namespace rockyard::perception
