// What the slip check of a drive had to find, in truth: the observer of a drive fills columns of
// the record by it. Nothing in the drive depends on it, and no other column than slip_onset_m and
// false_slip_alarms. Both looks of a reading have to be told by OnLook before TrulyExceeded.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>

#include "math/pose.h"
#include "messages/estimates.h"
#include "perception/visual_motion.h"
#include "trial/aids/visual_aid.h"

namespace rockyard::trial {

// Compares, at every control tick, the distance that the wheels rolled with the true one, over the
// last `min_way_m` that they rolled: what a perfect check without delay would find.
class SlipOnset {
 public:
  explicit SlipOnset(const perception::SlipCheckParams& params) : params_(params) {}

  // Takes the pose in the odometry frame, the true pose, and the true path length so far.
  void Observe(const messages::PoseEstimate& odometry, const math::Pose2& truth, double path_m);
  // Begins anew, after the rover was moved by hand.
  void Restart() { ticks_.clear(); }

  // Returns the true path length at which the limit was first exceeded, if it was.
  const std::optional<double>& path_m() const { return path_m_; }

  // Takes the true pose at a look of visual odometry.
  void OnLook(std::int64_t number, const math::Pose2& truth) {
    if (params_.enabled) looks_[number] = truth;
  }
  // Returns whether the true slip between the two looks of a reading exceeded the limit. Readings
  // come in the order of their looks.
  bool TrulyExceeded(const SlipReading& reading);

 private:
  struct Tick {
    messages::PoseEstimate odometry;
    math::Pose2 truth;
  };

  perception::SlipCheckParams params_;
  std::deque<Tick> ticks_;
  std::optional<double> path_m_;
  std::map<std::int64_t, math::Pose2> looks_;
};

// Returns the true motion in the plane from one pose to another, without error, as the check of
// slip takes motions.
messages::RelativeMotion TrueMotion(const math::Pose2& from, const math::Pose2& to);

}  // namespace rockyard::trial
