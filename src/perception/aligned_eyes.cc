#include "perception/aligned_eyes.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/error.h"
#include "vision/cameras/rectification.h"
#include "vision/stereo/pyramid.h"

namespace rockyard::perception {
namespace {

using vision::Image;

// A pixel of the reduced mask is free where all pixels are free whose mean it is.
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

// A pixel of the aligned mask is free where all pixels are free from which it is interpolated.
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

AlignedEyes::AlignedEyes(const vision::StereoRig& rig, int pyramid_level)
    : pyramid_level_(pyramid_level) {
  const int factor = 1 << pyramid_level;
  const vision::CameraModel left = vision::Reduced(rig.left, factor);
  const vision::CameraModel right = vision::Reduced(rig.right, factor);
  pair_ = PairOf(left, right);
  left_ = MakeEye(left, pair_.left, rig.left_free);
  right_ = MakeEye(right, pair_.right, rig.right_free);
}

AlignedEyes::Eye AlignedEyes::MakeEye(const vision::CameraModel& reduced,
                                      const vision::Cahv& aligned,
                                      const Image<std::uint8_t>& free) const {
  Eye eye{std::nullopt, ReducedMask(free, pyramid_level_)};
  const vision::Cahv* linear = std::get_if<vision::Cahv>(&reduced.lens);
  // Cameras that are aligned already are left as they are: resampling would blur.
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

vision::GrayImage AlignedEyes::Aligned(const Eye& eye, const vision::GrayImage& image) const {
  vision::GrayImage reduced = vision::ReduceImage(image, pyramid_level_);
  return eye.table ? eye.table->Rectify(reduced) : reduced;
}

}  // namespace rockyard::perception
