// Which moments of a drive the page of a replay needs (ReplayJson), and transforms and paths of
// trace_mcap.h. Other parts of trace files keep all of them. No record depends on it: another
// choice is as good where it keeps what ThinMotion promises.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "replay/data.h"

namespace rockyard::replay {

// How far the motion that a page shows between two kept moments may be from the recorded one. Must
// agree: the page interpolates as ShownError does (positions and angles linearly in time, attitudes
// by slerp), and payload.ts says that joints have twice the tolerance of angles.
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
  MotionTolerance tolerance;      // which the kept moments hold
};

// The most moments of a motion that a page holds.
inline constexpr std::size_t kMaxMoments = 8000;

// Chooses the moments to keep. First and last moment, those at both sides of a setting back, and
// the last one of every stretch of one activity are kept in any case; between them as many as the
// tolerance asks for (Ramer 1972, Douglas and Peucker 1973: the moment that is furthest off is
// kept, then both parts are looked at). Where these are more than `most`, the tolerance grows by
// half, again and again, until they are not, or it is more than a thousand times the first. Poses
// must be in the order of time. Cost: some n log n of n poses.
ThinnedMotion ThinMotion(std::span<const ReplayPose> poses, std::size_t most = kMaxMoments);

// Returns how far a pose is from what is shown at its time between two others, as a share of the
// tolerance: at most 1 where it may be left out. It is the largest share of position, attitude,
// believed pose and joints.
double ShownError(const ReplayPose& before, const ReplayPose& after, const ReplayPose& pose,
                  const MotionTolerance& tolerance);

}  // namespace rockyard::replay
