// What the rover believes of its own error, held against the truth.
#pragma once

#include <optional>

#include "math/pose.h"
#include "messages/estimates.h"

namespace rockyard::trial {

struct Belief {
  double position_sd_m = 0.0;  // root of the summed variances of x and y
  double heading_sd_rad = 0.0;
  double nees = 0.0;       // e' P^-1 e of x, y, heading: chi-squared, 3 degrees of freedom
  bool inside_95 = false;  // nees is at most that distribution's 95 % quantile
};

// The believed pose in the world frame.
const messages::PoseEstimate& WorldPose(const messages::LocalizationEstimate& estimate);

// Of the world frame. Nothing where the estimate has no covariance, or one that is not positive
// definite: an oracle's, and that of a rover that has not moved.
std::optional<Belief> BeliefOf(const messages::LocalizationEstimate& estimate,
                               const math::Pose2& truth_W);

// The same of the frame in which goals are told, and the true pose in it.
std::optional<Belief> GoalFrameBeliefOf(const messages::LocalizationEstimate& estimate,
                                        const math::Pose2& truth);

}  // namespace rockyard::trial
