// How far the cameras of a stereo rig drift apart after they were calibrated.
#pragma once

#include "core/fields.h"

namespace rockyard::vision {

// Standard deviations of what one rig has drifted, drawn once a trial. All zero by default: the
// cameras are where their calibration says. The ranges of studies are assumed: a quarter of a
// milliradian is what a bar of 0.25 m bends by when one of its faces, 20 mm from the other, becomes
// 1 K warmer or so (23e-6 / K of aluminium), and mounts slip by more.
struct RigDriftParams {
  double roll_sd_rad = 0.0;
  double pitch_sd_rad = 0.0;
  double yaw_sd_rad = 0.0;
  double baseline_sd_m = 0.0;
  double focal_sd_percent = 0.0;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::vision
