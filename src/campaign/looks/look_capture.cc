#include "campaign/looks/look_capture.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "campaign/stereo/stereo_products.h"
#include "image_files/png_file.h"
#include "vision/stereo/pyramid.h"
#include "web/page.h"

namespace rockyard::campaign {
namespace {

using image_files::Picture;
using messages::LookDirection;

std::int64_t NumberOf(const CapturedLook& look) { return look.cloud.number; }

int LevelOf(const vision::GrayImage& image) {
  int level = 0;
  while ((std::max(image.width(), image.height()) >> level) > kLargestRecordSide_px) ++level;
  return level;
}

// Of the middle of every 2^level x 2^level pixels one: a mean of colours would be no disparity.
Picture Thinned(const Picture& picture, int level) {
  const int side = 1 << level;
  Picture thinned(picture.width() / side, picture.height() / side);
  for (int y = 0; y < thinned.height(); ++y) {
    for (int x = 0; x < thinned.width(); ++x) {
      thinned.At(x, y) = picture.At(x * side + side / 2, y * side + side / 2);
    }
  }
  return thinned;
}

}  // namespace

CapturedLook Capture(const trial::WatchedStereo& watched) {
  return {watched.X_WR, watched.sight, watched.pair, watched.matching, watched.cloud};
}

void LookMemory::Add(CapturedLook look) { looks_.push_back(std::move(look)); }

std::vector<CapturedLook> LookMemory::LooksOf(const messages::PointCloud& cloud) {
  std::vector<CapturedLook> found;
  std::vector<CapturedLook> later;
  for (CapturedLook& look : looks_) {
    if (NumberOf(look) > cloud.number) {
      later.push_back(std::move(look));
    } else if (NumberOf(look) == cloud.number) {
      found.push_back(std::move(look));
    } else if (cloud.direction == LookDirection::kBehind &&
               look.cloud.direction == LookDirection::kAhead) {
      found.clear();
      found.push_back(std::move(look));
    }
  }
  looks_ = std::move(later);
  return found;
}

replay::ReplayLook LookRecord(const trial::WatchedStereo& watched, double time_s) {
  const vision::GrayImage& left = watched.sight.left;
  const vision::CorrelatorParams& range = watched.matching.correlator;
  const int level = LevelOf(left);
  const Picture disparities = Thinned(DisparityPicture(watched.sight.disparities, range), level);
  return {.time_s = time_s,
          .number = watched.cloud.number,
          .behind = watched.cloud.direction == messages::LookDirection::kBehind,
          .points = static_cast<std::int64_t>(watched.cloud.points_R.size()),
          .least_disparity_px = static_cast<double>(range.min_disparity_px),
          .most_disparity_px = static_cast<double>(range.min_disparity_px + range.disparities - 1),
          .left_png = web::Base64(image_files::EncodePng(vision::ReduceImage(left, level))),
          .disparity_png = web::Base64(image_files::EncodePng(disparities))};
}

}  // namespace rockyard::campaign
