// The frame in which a rover's own path is smooth. Corrections of the estimate move the world in
// it, not the rover: what the rover has seen and what it is doing keep their places around it.
#pragma once

#include "math/pose.h"
#include "messages/estimates.h"

namespace rockyard::navigation {

// The frame O, level as the estimated world W, and W itself before the first correction.
class OdometryFrame {
 public:
  // The estimate in W jumps from `before` to `after`, while the rover stays where it is in O.
  void Correct(const messages::PoseEstimate& before, const messages::PoseEstimate& after);

  // Headings stay within [-pi, pi]; the odometer is the same in every frame.
  messages::PoseEstimate FromWorld(const messages::PoseEstimate& estimate_W) const;
  messages::Goal FromWorld(const messages::Goal& goal_W) const;

 private:
  math::Pose2 X_OW_;  // of W in O
};

}  // namespace rockyard::navigation
