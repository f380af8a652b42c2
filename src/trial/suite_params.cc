#include "trial/suite_params.h"

namespace rockyard::trial {

void SensorParams::Visit(core::FieldVisitor& v) {
  terrain_sensors.Visit(v);
  v.Group("light_stripe", light_stripe, "light stripe hazard sensor");
  v.Group("stereo", stereo, "stereo cameras ahead and behind");
  v.Group("sun", sun,
          "sunlight on the terrain and how bright it is; the images of a sensor see it");
  v.Group("look", look, "what soil and rocks look like; stereo images see it");
  v.Group("gyro", gyro, "turn rate sensor");
  v.Group("encoders", encoders, "wheel encoders");
  v.Group("tracker", tracker, "overhead tracker that reports the true pose in experiments");
  v.Group("vehicle", vehicle, "what the rover feels of itself: touch, tilt, joints, motors");
  v.Group("aids", aids, "what tells the rover where it is, beside its wheels and gyro");
  v.Group("visual_odometry", visual_odometry, "how the rover moves, as its cameras see it");
}

void PerceptionParams::Visit(core::FieldVisitor& v) {
  v.Group(
      "stripe_finder", stripe_finder,
      "light stripes found in images; where the light stripe sensor is simulated down to images");
  v.Group("stereo", stereo, "matching of stereo images (sensors.stereo.fidelity image)");
  v.Group("hazard", hazard, "hazard criteria and the two-scan rule");
  v.Group("vehicle_hazard", vehicle_hazard, "hazards that the rover feels (sensors.vehicle)");
  v.Group("stuck_detector", stuck_detector,
          "when the rover takes itself for stuck (navigation.on_board_stuck)");
  v.Group("dead_reckoning", dead_reckoning, "pose from wheel encoders and gyro");
  v.Group("calibration", calibration,
          "how wrong the rover is about its own geometry: believed less true");
  v.Group("attitude", attitude, "roll, pitch and height from accelerometers and odometry");
  v.Group("cloud_elevations", cloud_elevations,
          "elevation array that the behaviour controller makes of stereo's points");
  v.Group("visual_odometry", visual_odometry,
          "what the rover makes of motions that it sees (sensors.visual_odometry)");
}

void NavigationParams::Visit(core::FieldVisitor& v) {
  navigators.Visit(v);
  v.Group("on_board_stuck", on_board_stuck,
          "what a rover does that notices that it is stuck, whichever its navigator");
  v.Group("on_slip", on_slip, "what a rover does whose check of slip raises an alarm");
  v.Group("wheel_driver", wheel_driver, "from motions to wheel and steering set points");
}

}  // namespace rockyard::trial
