// On-board visual odometry: from the images of a pair to a motion since its keyframe.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "core/random.h"
#include "math/pose.h"
#include "perception/visual_odometry.h"
#include "sensing/stereo_rig.h"
#include "trial/drive_params.h"
#include "vision/odometry/estimate_motion.h"

namespace rockyard::trial {

// What one pair of images adds. `reference` and this pair are numbers of looks; where a motion was
// found it is that of R from the reference to this one.
struct VisualStep {
  std::int64_t number = 0;
  std::int64_t reference = 0;
  bool keyframe = false;  // whether later looks are compared with this one
  vision::MotionResult result;
};

// What leaves the world: images, or the step that an error model gives in their place.
using MotionData = std::variant<VisualStep, sensing::StereoImages>;

// Odometry with the cameras that the rover believes to have. Where an error model speaks, it says
// what that does.
class VisualReader {
 public:
  // `drive` outlives it. The odometry is made at the first images.
  VisualReader(const DriveParams& drive, core::TrialKey key) : drive_(drive), key_(key) {}

  // Takes the next look; looks count from 0. `predicted` is where on-board software expects R, in R
  // of the keyframe. Cost of images: a step of vision::VisualOdometer.
  VisualStep Read(const MotionData& data, const math::Transform& predicted);

  // What was seen before is of no use any more: the next pair is a keyframe.
  void Renew();
  void OnPlaced() { Renew(); }

 private:
  const DriveParams& drive_;
  core::TrialKey key_;
  std::optional<perception::VisualOdometry> odometry_;
};

}  // namespace rockyard::trial
