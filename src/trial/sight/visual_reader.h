// On-board visual odometry: from a pair of images to the motion since the keyframe. Onboard reads
// the looks of visual odometry with it, and visual_aid.h hands the motions to the estimator.
// Records depend on its random numbers where images are taken: the samples of consensus, drawn by
// the trial's key and the number of the look (Purpose::kRansac).
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

// What one pair of images adds. A motion that was found is that of R from `reference` to `number`.
struct VisualStep {
  std::int64_t number = 0;     // of this look
  std::int64_t reference = 0;  // number of the look that it was compared with
  bool keyframe = false;       // whether later looks are compared with this one
  vision::MotionResult result;
};

// What leaves the world: images, or the step that an error model gives in their place.
using MotionData = std::variant<VisualStep, sensing::StereoImages>;

// Odometry with the cameras as the rover believes that they are mounted. A step of the error model
// is passed on as it is.
class VisualReader {
 public:
  // `drive` outlives it. The odometry is made at the first images.
  VisualReader(const DriveParams& drive, core::TrialKey key) : drive_(drive), key_(key) {}

  // Takes the next look; looks count from 0. `predicted` is where on-board software expects R, in R
  // of the keyframe. Cost of images: a step of vision::VisualOdometer.
  VisualStep Read(const MotionData& data, const math::Transform& predicted);

  // Makes the next pair a keyframe, as what was seen before is of no use any more.
  void Renew();
  void OnPlaced() { Renew(); }

 private:
  const DriveParams& drive_;
  core::TrialKey key_;
  std::optional<perception::VisualOdometry> odometry_;
};

}  // namespace rockyard::trial
