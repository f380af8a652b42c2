// The right camera of a rig that has drifted against the left one since both were calibrated. The
// stereo imager draws the drift of each pair once a trial and takes images by the drifted camera;
// software on board keeps the calibrated pair and does not know.
//
// In the right camera's own frame (x along its columns, y down, z along the ray of the middle of
// its image; all by its rays, so for every lens) the camera is turned about its centre by
//   Ry(-yaw) Rx(-pitch) Rz(roll),
// its centre moves along the baseline, and its image grows about its middle. Small changes of a
// point's place in the right image (a linear camera of focal length f, point at slopes (a, b)):
//   column: f yaw (1 + a^2) - f pitch a b + f roll b      (turned in by yaw, a far point has
//   row:    f yaw a b - f pitch (1 + b^2) - f roll a       f yaw less disparity)
#pragma once

#include "core/random.h"
#include "vision/cameras/camera_model.h"
#include "vision/cameras/rig_drift_params.h"

namespace rockyard::vision {

// The true right camera less what its calibration says. Signs are as seen from behind the camera.
struct RigDrift {
  double roll_rad = 0.0;     // > 0: turned right side down
  double pitch_rad = 0.0;    // > 0: looks further down
  double yaw_rad = 0.0;      // > 0: looks further left, towards the left camera's view
  double baseline_m = 0.0;   // > 0: further from the left camera
  double focal_share = 0.0;  // > 0: its focal length is longer by this share

  bool operator==(const RigDrift&) const = default;
};

// Returns independent normal numbers. Records depend on the draws: always five, in the order of the
// members, whatever the deviations are, so that a change of one deviation leaves the other numbers.
RigDrift DrawRigDrift(const RigDriftParams& params, core::RandomStream& stream);

// Returns the drifted right camera in the outer frame of both. Records depend on this: without
// drift it is `right` itself, bit for bit. Requires centres apart and a ray in the middle of the
// right image.
CameraModel DriftedRight(const CameraModel& left, const CameraModel& right, const RigDrift& drift);

}  // namespace rockyard::vision
