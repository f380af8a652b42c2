// How far the cameras of a stereo rig drift apart after they were calibrated: the group `drift` of
// a scenario's stereo images, drawn from by rig_drift.h.
#pragma once

#include "core/fields.h"

namespace rockyard::vision {

// Standard deviations of the drift of one rig. With the default of 0 the cameras are where their
// calibration says. The ranges of studies are assumed: an aluminium bar (23e-6 / K) of 0.25 m bends
// by about a quarter of a milliradian when one of its faces, 20 mm from the other, becomes 1 K
// warmer, and mounts slip by more.
struct RigDriftParams {
  double roll_sd_rad = 0.0;
  double pitch_sd_rad = 0.0;
  double yaw_sd_rad = 0.0;
  double baseline_sd_m = 0.0;
  double focal_sd_percent = 0.0;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::vision
