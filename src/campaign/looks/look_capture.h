// Everything that can be shown of one look of stereo cameras, kept from the moment when it happens,
// and what a replay page keeps of it.
#pragma once

#include <vector>

#include "math/pose.h"
#include "messages/point_cloud.h"
#include "perception/stereo_points.h"
#include "replay/data.h"
#include "trial/watchers.h"
#include "vision/cameras/rectification.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::campaign {

// See trial::WatchedStereo. 50 kB with images of 128 x 128 pixels, and the points.
struct CapturedLook {
  math::Transform X_WR = math::Transform::Identity();
  perception::StereoSight sight;
  vision::RectifiedPair pair;
  vision::StereoPipelineParams matching;
  messages::PointCloud cloud;
};

CapturedLook Capture(const trial::WatchedStereo& watched);

// The looks on which the decisions of a navigator rest.
class LookMemory {
 public:
  void Add(CapturedLook look);

  // Of a decision that followed `cloud`: its look, and where that was a look behind the last one
  // ahead before it; in the order in which they were taken. Forgets what came before.
  std::vector<CapturedLook> LooksOf(const messages::PointCloud& cloud);

 private:
  std::vector<CapturedLook> looks_;
};

// Sides of its pictures are at most this long, px: larger images are reduced by powers of two.
inline constexpr int kLargestRecordSide_px = 160;

// The look at `time_s` with its pictures. Cost: some milliseconds.
replay::ReplayLook LookRecord(const trial::WatchedStereo& watched, double time_s);

}  // namespace rockyard::campaign
