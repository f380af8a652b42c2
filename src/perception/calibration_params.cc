#include "perception/calibration_params.h"

#include <string_view>

namespace rockyard::perception {
namespace {

using core::Setting;

void Percent(core::FieldVisitor& v, std::string_view name, double& value, std::string_view doc) {
  v.Real(name, value, Setting(doc, {-20.0, 20.0}));
}

void Angle(core::FieldVisitor& v, std::string_view name, double& value_rad, std::string_view doc) {
  v.Angle(name, value_rad, Setting(doc, {-10.0, 10.0}));
}

void Shift(core::FieldVisitor& v, std::string_view name, double& value_m, std::string_view doc) {
  v.Real(name, value_m, Setting(doc, {-0.1, 0.1}));
}

}  // namespace

void DriveCalibrationErrors::Visit(core::FieldVisitor& v) {
  Percent(v, "wheel_radius_percent", wheel_radius_percent,
          "by how much wheels are believed too large");
  Percent(v, "wheel_radius_left_right_percent", wheel_radius_left_right_percent,
          "by how much left wheels are believed too large against right ones, half on either side");
  Percent(v, "track_percent", track_percent,
          "by how much wheels are believed too far from the middle plane");
  Percent(v, "wheelbase_percent", wheelbase_percent,
          "by how much wheels are believed too far from the chassis centre along the rover");
  Angle(v, "steering_offset_deg", steering_offset_rad,
        "angle to the left of a steered wheel that is believed to stand straight");
}

void CameraCalibrationErrors::Visit(core::FieldVisitor& v) {
  Angle(v, "roll_deg", roll_rad, "believed turned too far about its optical axis, right side down");
  Angle(v, "pitch_deg", pitch_rad, "believed to look too far down");
  Angle(v, "yaw_deg", yaw_rad, "believed to look too far left");
  Shift(v, "x_m", x_m, "believed too far forward");
  Shift(v, "y_m", y_m, "believed too far left");
  Shift(v, "z_m", z_m, "believed too high");
}

void LaserCalibrationErrors::Visit(core::FieldVisitor& v) {
  constexpr std::array<std::string_view, messages::kStripes> kNames{
      "leftmost_deg", "left_deg", "centre_deg", "right_deg", "rightmost_deg"};
  for (std::size_t stripe = 0; stripe < kNames.size(); ++stripe) {
    Angle(v, kNames[stripe], angle_rad[stripe], "light plane believed turned too far left");
  }
}

void CalibrationErrorParams::Visit(core::FieldVisitor& v) {
  v.Group("drive", drive, "wheels and steering");
  v.Group("left_camera", left_camera, "left camera of the light stripe sensor");
  v.Group("right_camera", right_camera, "right camera of the light stripe sensor");
  v.Group("lasers", lasers, "lasers of the light stripe sensor");
  v.Group("stereo_front", stereo_front, "stereo cameras at the front, as one rigid pair");
  v.Group("stereo_rear", stereo_rear, "stereo cameras at the rear, as one rigid pair");
}

}  // namespace rockyard::perception
