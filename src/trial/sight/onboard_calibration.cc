#include "trial/sight/onboard_calibration.h"

#include <numbers>
#include <variant>

#include "math/pose.h"
#include "rover/rover_layout_params.h"
#include "sensing/stereo_rig.h"
#include "sensing/stripe_layout_params.h"
#include "vision/cameras/cahv.h"

namespace rockyard::trial {
namespace {

using math::Vector3;

double Factor(double percent) { return 1.0 + 0.01 * percent; }

// Turns the camera about its own axes and shifts it along those of R. Records depend on the order.
void Misplace(const perception::CameraCalibrationErrors& errors, math::Transform& X_RC) {
  const Eigen::Matrix3d turned = (math::RotationAbout(errors.yaw_rad, Vector3::UnitZ()) *
                                  math::RotationAbout(errors.pitch_rad, Vector3::UnitY())) *
                                 math::RotationAbout(errors.roll_rad, Vector3::UnitX());
  X_RC.linear() = (X_RC.linear() * turned).eval();
  X_RC.translation() += Vector3(errors.x_m, errors.y_m, errors.z_m);
}

bool Any(const perception::CameraCalibrationErrors& e) {
  return e.roll_rad != 0.0 || e.pitch_rad != 0.0 || e.yaw_rad != 0.0 || e.x_m != 0.0 ||
         e.y_m != 0.0 || e.z_m != 0.0;
}

}  // namespace

messages::DriveCalibration OnboardDriveCalibration(
    const rover::RoverParams& rover, const perception::DriveCalibrationErrors& errors) {
  messages::DriveCalibration calibration = rover::MakeDriveCalibration(rover);
  calibration.wheel_radius_m *= Factor(errors.wheel_radius_percent);
  for (std::size_t wheel = 0; wheel < messages::kWheelCount; ++wheel) {
    const double side = calibration.wheel_y_m[wheel] > 0.0 ? 0.5 : -0.5;
    calibration.radius_ratio[wheel] *= Factor(side * errors.wheel_radius_left_right_percent);
    calibration.wheel_x_m[wheel] *= Factor(errors.wheelbase_percent);
    calibration.wheel_y_m[wheel] *= Factor(errors.track_percent);
  }
  // MakeDriveCalibration has no offset, so that it is set, not added.
  calibration.steering_offset_rad = errors.steering_offset_rad;
  return calibration;
}

messages::RoverBelief OnboardRoverBelief(const rover::RoverParams& rover,
                                         const perception::DriveCalibrationErrors& errors,
                                         const perception::VehicleHazardParams& felt) {
  const rover::RoverGeometryParams& geometry = rover.geometry;
  const rover::RoverGeometry places = rover::MakeRoverGeometry(geometry);
  const Vector3& rocker = places.rocker_pivot_R.front();
  const Vector3& bogie = places.bogie_pivot_R.front();
  return {.drive = OnboardDriveCalibration(rover, errors),
          .length_m = geometry.length_m,
          .width_m = geometry.width_m,
          .belly_clearance_m = geometry.belly_clearance_m,
          .wheel_width_m = geometry.wheel_width_m,
          .max_rocker_rad = geometry.rocker_limit_rad,
          .max_bogie_rad = geometry.bogie_limit_rad,
          .max_tilt_rad = felt.max_tilt_rad,
          .suspension = {.bogies_at_front = geometry.bogie_end == rover::BogieEnd::kFront,
                         .rocker_pivot_x_m = rocker.x(),
                         .rocker_pivot_z_m = rocker.z(),
                         .bogie_pivot_x_m = bogie.x(),
                         .bogie_pivot_z_m = bogie.z(),
                         .pivot_y_m = rocker.y(),
                         .belly_length_m = geometry.belly_length_m,
                         .belly_width_m = geometry.belly_width_m}};
}

messages::StripeCalibration OnboardStripeCalibration(
    const sensing::LightStripeParams& sensor, const perception::CalibrationErrorParams& errors) {
  messages::StripeCalibration calibration = sensing::TrueCalibration(sensor);
  Misplace(errors.left_camera, calibration.cameras[0].X_RC);
  Misplace(errors.right_camera, calibration.cameras[1].X_RC);
  const std::size_t last = calibration.lasers.size() - 1;
  for (std::size_t stripe = 0; stripe <= last; ++stripe) {
    // A denser array has the published lasers and one midway between each two, which has the error
    // of its neighbour on the right.
    const std::size_t published = (stripe * (messages::kStripes - 1) + last / 2) / last;
    const Eigen::Matrix3d turned =
        math::RotationAbout(errors.lasers.angle_rad[published], Vector3::UnitZ());
    messages::StripeLaser& laser = calibration.lasers[stripe];
    laser.normal_R = (turned * laser.normal_R).eval();
    laser.axis_R = (turned * laser.axis_R).eval();
  }
  return calibration;
}

std::optional<math::Transform> StereoMisplacement(const sensing::StereoParams& sensor,
                                                  const perception::CalibrationErrorParams& errors,
                                                  messages::LookDirection direction) {
  const bool ahead = direction == messages::LookDirection::kAhead;
  const perception::CameraCalibrationErrors& error =
      ahead ? errors.stereo_front : errors.stereo_rear;
  if (!Any(error)) return std::nullopt;
  const sensing::StereoMountParams& mount = ahead ? sensor.front : sensor.rear;
  // The middle of the pair as MakeStereoView (sensing/stereo_view.cc) mounts it: keep both alike.
  const math::Transform X_RC =
      math::MakePose({ahead ? mount.ahead_m : -mount.ahead_m, 0.0, mount.height_m},
                     ahead ? 0.0 : std::numbers::pi, mount.pitch_rad, 0.0);
  math::Transform believed = X_RC;
  Misplace(error, believed);
  return believed * X_RC.inverse();
}

BelievedCameras OnboardCameras(const sensing::StereoParams& sensor,
                               const perception::CalibrationErrorParams& errors,
                               messages::LookDirection direction) {
  const auto misplaced = StereoMisplacement(sensor, errors, direction);
  const auto believed = [&](const vision::CameraModel& camera) -> messages::LinearCamera {
    const auto& calibrated = std::get<vision::Cahv>(camera.lens);
    const vision::Cahv cahv = misplaced ? vision::Moved(*misplaced, calibrated) : calibrated;
    return {cahv.C, cahv.A, cahv.H, cahv.V};
  };
  const auto [left, right] = sensing::CalibratedCameras(sensor, direction);
  return {believed(left), believed(right)};
}

}  // namespace rockyard::trial
