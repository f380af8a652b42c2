// The lander's stereo cameras on their mast, turned towards a goal.
//
// Frame L: origin on the ground under the mast, x along the ground towards the goal, y to the left,
// z up. The cameras stand half a baseline to the left and right of the mast's top, look in parallel
// down the line from there to the goal, and image by a pinhole whose middle pixels cover pixel_rad.
#pragma once

#include <optional>

#include "math/pose.h"
#include "vision/cameras/cahv.h"
#include "vision/cameras/camera_types.h"

namespace rockyard::experiments {

struct LanderCameras {
  double pixel_rad = 0.001;
  double baseline_m = 0.15;
  double mast_height_m = 1.5;
  int image_side_px = 256;
};

// A place as it is measured in the images.
struct StereoPick {
  vision::Pixel left_px = vision::Pixel::Zero();  // column, row
  double disparity_px = 0.0;                      // column_left - column_right
};

class LanderPair {
 public:
  // Turned towards p_goal_L, which is not the mast's top.
  LanderPair(const LanderCameras& cameras, const math::Vector3& p_goal_L);

  // Where both cameras image a place; nothing where one of them has it behind its back.
  std::optional<StereoPick> See(const math::Vector3& p_L) const;

  // The place in L that stands for a measurement, triangulated. Nothing where its disparity is not
  // positive, so that it lies at infinity or beyond.
  std::optional<math::Vector3> Place(const StereoPick& pick) const;

 private:
  vision::Cahv left_;
  vision::Cahv right_;
};

// The place as it is told in the lander's frame by a pan axis whose angle is wrong by pan_rad,
// positive to the left.
math::Vector3 Panned(const math::Vector3& p_L, double pan_rad);

}  // namespace rockyard::experiments
