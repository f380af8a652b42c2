// Where the wheels first slipped more than the limit of the slip check, in truth.
#pragma once

#include <deque>
#include <optional>

#include "math/pose.h"
#include "messages/estimates.h"
#include "perception/visual_motion.h"

namespace rockyard::trial {

// Holds the way of the wheels against the true one over the last `min_way_m` that the wheels
// rolled, once a control tick: what a check that saw everything at once would know.
class SlipOnset {
 public:
  explicit SlipOnset(const perception::SlipCheckParams& params) : params_(params) {}

  // The odometry frame's pose, the true one, and the true path length so far.
  void Observe(const messages::PoseEstimate& odometry, const math::Pose2& truth, double path_m);
  // The rover was moved by hand.
  void Restart() { ticks_.clear(); }

  // True path length at which the limit was first exceeded.
  const std::optional<double>& path_m() const { return path_m_; }

 private:
  struct Tick {
    messages::PoseEstimate odometry;
    math::Pose2 truth;
  };

  perception::SlipCheckParams params_;
  std::deque<Tick> ticks_;
  std::optional<double> path_m_;
};

// The true motion in the plane from one pose to another as a check of slip takes it, without error.
messages::RelativeMotion TrueMotion(const math::Pose2& from, const math::Pose2& to);

}  // namespace rockyard::trial
