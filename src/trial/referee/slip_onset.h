// What the slip check of a drive had to find, in truth.
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

  // The odometry frame's pose, the true one, and the true path length so far.
  void Observe(const messages::PoseEstimate& odometry, const math::Pose2& truth, double path_m);
  // The rover was moved by hand.
  void Restart() { ticks_.clear(); }

  // True path length at which the limit was first exceeded.
  const std::optional<double>& path_m() const { return path_m_; }

  // Visual odometry looks from there.
  void OnLook(std::int64_t number, const math::Pose2& truth) {
    if (params_.enabled) looks_[number] = truth;
  }
  // Whether the wheels truly slipped that much between the two looks of a reading. Readings come in
  // the order of their looks.
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

// The true motion in the plane from one pose to another as a check of slip takes it, without error.
messages::RelativeMotion TrueMotion(const math::Pose2& from, const math::Pose2& to);

}  // namespace rockyard::trial
