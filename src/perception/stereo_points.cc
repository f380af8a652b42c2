#include "perception/stereo_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/error.h"
#include "vision/cameras/aligned_pair.h"
#include "vision/cameras/triangulation.h"
#include "vision/stereo/outside.h"
#include "vision/stereo/pyramid.h"
#include "vision/stereo/stereo.h"

namespace rockyard::perception {
namespace {

using vision::Image;

// Whole disparities from `search`, and one more on either side for the peak filter.
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

// A pixel of the reduced mask is free where all pixels that it is the mean of are.
Image<std::uint8_t> ReducedMask(const Image<std::uint8_t>& free, int level) {
  const int side = 1 << level;
  Image<std::uint8_t> reduced(free.width() / side, free.height() / side, 1);
  for (int y = 0; y < reduced.height() * side; ++y) {
    for (int x = 0; x < reduced.width() * side; ++x) {
      if (free.At(x, y) == 0) reduced.At(x / side, y / side) = 0;
    }
  }
  return reduced;
}

// A pixel of the aligned mask is free where all pixels that it is interpolated from are.
Image<std::uint8_t> AlignedMask(const vision::RectificationTable& table,
                                const Image<std::uint8_t>& free) {
  constexpr std::uint8_t kWhite = 255;
  vision::GrayImage white(free.width(), free.height());
  std::transform(free.values().begin(), free.values().end(), white.values().begin(),
                 [](std::uint8_t one) { return one == 0 ? std::uint8_t{0} : kWhite; });
  Image<std::uint8_t> aligned = table.Rectify(white);
  for (std::uint8_t& pixel : aligned.values()) pixel = pixel == kWhite ? 1 : 0;
  return aligned;
}

vision::RectifiedPair PairOf(const vision::CameraModel& left, const vision::CameraModel& right) {
  if (const auto aligned = vision::AlignedPair(left, right)) return *aligned;
  core::Result<vision::RectifiedPair> found = vision::Rectify(left, right);
  if (!found.ok()) throw core::UserError(found.problems());
  return *found;
}

}  // namespace

StereoPoints::StereoPoints(const StereoMatchingParams& params, const StereoSearch& search,
                           const vision::StereoRig& rig)
    : params_(PipelineOf(params, search)), search_(search) {
  const int factor = 1 << search.pyramid_level;
  const vision::CameraModel left = vision::Reduced(rig.left, factor);
  const vision::CameraModel right = vision::Reduced(rig.right, factor);
  pair_ = PairOf(left, right);
  left_ = MakeEye(left, pair_.left, rig.left_free);
  right_ = MakeEye(right, pair_.right, rig.right_free);
}

StereoPoints::Eye StereoPoints::MakeEye(const vision::CameraModel& reduced,
                                        const vision::Cahv& aligned,
                                        const Image<std::uint8_t>& free) const {
  Eye eye{std::nullopt, ReducedMask(free, search_.pyramid_level)};
  const vision::Cahv* linear = std::get_if<vision::Cahv>(&reduced.lens);
  if (linear != nullptr && *linear == aligned && reduced.size == pair_.size) return eye;
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  Image<vision::SourcePosition> positions(pair_.size.columns, pair_.size.rows,
                                          {kNowhere, kNowhere});
  for (int y = 0; y < positions.height(); ++y) {
    for (int x = 0; x < positions.width(); ++x) {
      const auto source = vision::SourceOf(reduced, aligned, vision::Pixel(x, y));
      if (source) positions.At(x, y) = {source->x(), source->y()};
    }
  }
  eye.table.emplace(positions, reduced.size.columns, reduced.size.rows);
  eye.free = AlignedMask(*eye.table, eye.free);
  return eye;
}

vision::GrayImage StereoPoints::Aligned(const Eye& eye, const vision::GrayImage& image) const {
  vision::GrayImage reduced = vision::ReduceImage(image, search_.pyramid_level);
  return eye.table ? eye.table->Rectify(reduced) : reduced;
}

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
      const auto point = vision::Triangulate(pair_.left, pair_.right, vision::Pixel(x, y),
                                             vision::DisparityPx(disparity));
      if (point && (point->p_A - pair_.left.C).norm() <= search_.max_range_m) {
        points_R.push_back(point->p_A);
      }
    }
  }
  return points_R;
}

StereoSight StereoPoints::See(const vision::GrayImage& left, const vision::GrayImage& right) const {
  StereoSight sight;
  sight.left = Aligned(left_, left);
  sight.disparities = vision::MatchStereo(sight.left, Aligned(right_, right), params_);
  vision::DropOutside(left_.free, right_.free, static_cast<int>(params_.correlator.window_side_px),
                      sight.disparities);
  DropOutOfRange(sight.disparities);
  sight.points_R = PointsOf(sight.disparities);
  return sight;
}

}  // namespace rockyard::perception
