// Which moments of a drive the page of a replay needs. Trace files (trace_npz.h) keep all of them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "replay/data.h"

namespace rockyard::replay {

// How far what is shown between two moments that are kept may be from the truth, where positions
// and angles are interpolated linearly in time and attitudes along the shortest turn (slerp).
struct MotionTolerance {
  double position_m = 0.002;               // true and believed
  double angle_rad = math::DegToRad(0.5);  // attitude and believed heading
  double joint_rad = math::DegToRad(1.0);  // rocker, bogie, steering, wheels
  MotionTolerance Scaled(double by) const {
    return {by * position_m, by * angle_rad, by * joint_rad};
  }
};

struct ThinnedMotion {
  std::vector<std::size_t> kept;  // indices of poses, ascending
  MotionTolerance tolerance;      // that they keep
};

// Most moments of a motion that a page holds.
inline constexpr std::size_t kMaxMoments = 8000;

// Keeps first and last moment, those at both sides of a setting back, the last one of every stretch
// of one activity, and between them as many as the tolerance asks for (Ramer 1972, Douglas and
// Peucker 1973: the moment that is furthest off is kept, then both parts are looked at). Where that
// is more than `most`, the tolerance grows by half until it is not, or until nothing more can be
// left out. Poses are in the order of time. Cost: some n log n of n poses.
ThinnedMotion ThinMotion(std::span<const ReplayPose> poses, std::size_t most = kMaxMoments);

// How far the pose is from what is shown at its time between two others, as a share of the
// tolerance: at most 1 where it may be left out. The largest of position, attitude, believed pose
// and joints.
double ShownError(const ReplayPose& before, const ReplayPose& after, const ReplayPose& pose,
                  const MotionTolerance& tolerance);

}  // namespace rockyard::replay
