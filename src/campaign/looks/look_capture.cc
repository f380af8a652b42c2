#include "campaign/looks/look_capture.h"

#include <cstdint>
#include <utility>

namespace rockyard::campaign {
namespace {

using messages::LookDirection;

std::int64_t NumberOf(const CapturedLook& look) { return look.cloud.number; }

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

}  // namespace rockyard::campaign
