// The cameras of visual odometry as the closed loop uses them: a pose in, a motion out.
#pragma once

#include <cstdint>
#include <memory>

#include "core/random.h"
#include "math/pose.h"
#include "terrain/terrain.h"
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

// One interface for both fidelities (sensors.visual_odometry.fidelity).
class VisualEyes {
 public:
  virtual ~VisualEyes() = default;

  // Takes the next pair of images, of a rover at X_WR. `predicted` is where on-board software
  // expects R, in R of the keyframe. Cost: 1 us, or that of two rendered images and a step of
  // vision::VisualOdometer.
  virtual VisualStep Look(const math::Transform& X_WR, const math::Transform& predicted) = 0;

  // What was seen before is of no use any more: the next pair is a keyframe.
  virtual void Renew() = 0;
};

// `terrain` outlives it.
std::unique_ptr<VisualEyes> MakeVisualEyes(const DriveParams& drive, core::TrialKey key,
                                           const terrain::Terrain& terrain);

}  // namespace rockyard::trial
