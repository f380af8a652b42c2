#include "campaign/replay_sensor.h"

#include <array>
#include <string>
#include <vector>

#include "sensing/stereo_view.h"
#include "sensing/stripe_layout_params.h"
#include "vision/lens.h"

namespace rockyard::campaign {
namespace {

using math::Vector3;

constexpr std::string_view kLightStripe = "light_stripe";

// Calls ray(u, v) once around the unit square, from the upper left corner along the upper edge.
template <typename Ray>
std::vector<Vector3> Rim(Ray ray) {
  std::vector<Vector3> rim;
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < kRimRaysOfASide; ++i) {
      const double share = static_cast<double>(i) / kRimRaysOfASide;
      const std::array<double, 4> u{share, 1.0, 1.0 - share, 0.0};
      const std::array<double, 4> v{0.0, share, 1.0, 1.0 - share};
      const auto at = static_cast<std::size_t>(side);
      rim.push_back(ray(u.at(at), v.at(at)));
    }
  }
  return rim;
}

replay::ReplayCamera StripeCamera(const messages::Camera& camera, const char* name) {
  const auto ray = [&](double u, double v) -> Vector3 {
    const vision::PixelPosition pixel{(u - 0.5) * camera.columns, (v - 0.5) * camera.rows};
    return camera.X_RC.linear() * vision::PixelRay(camera, pixel);
  };
  return {name, camera.X_RC.translation(), Rim(ray)};
}

void AddStereoPair(const sensing::StereoParams& params, messages::LookDirection direction,
                   const std::string& where, replay::ReplaySensor& sensor) {
  const sensing::StereoView view = sensing::MakeStereoView(params, direction);
  // The edges of the outer pixels.
  const auto ray = [&](double u, double v) -> Vector3 {
    return view.Ray(u * view.columns - 0.5, v * view.rows - 0.5).normalized();
  };
  const std::vector<Vector3> rim = Rim(ray);
  if (view.baseline_m == 0.0) {
    sensor.cameras.push_back({where, view.eye, rim});
    return;
  }
  sensor.cameras.push_back({where + " left", view.eye, rim});
  sensor.cameras.push_back({where + " right", view.right_eye, rim});
}

void AddLightStripe(const sensing::LightStripeParams& params, replay::ReplaySensor& sensor) {
  const messages::StripeCalibration calibration = sensing::TrueCalibration(params);
  sensor.reach_m = params.max_range_m;
  for (const messages::StripeLaser& laser : calibration.lasers) {
    sensor.lasers.push_back({laser.p_RoE_R, laser.normal_R, laser.axis_R, laser.half_fan_rad});
  }
  sensor.cameras = {StripeCamera(calibration.cameras[0], "camera 1"),
                    StripeCamera(calibration.cameras[1], "camera 2")};
}

}  // namespace

replay::ReplaySensor SensorOf(const scenario::Scenario& scenario) {
  const trial::DriveParams& drive = scenario.drive;
  const trial::TerrainSensorKind& chosen = drive.sensors.terrain_sensors.chosen();
  replay::ReplaySensor sensor;
  sensor.name = chosen.name();
  if (const sensing::StereoParams* stereo = chosen.cameras(drive)) {
    sensor.reach_m = stereo->max_range_m;
    AddStereoPair(*stereo, messages::LookDirection::kAhead, "ahead", sensor);
    AddStereoPair(*stereo, messages::LookDirection::kBehind, "behind", sensor);
  } else if (sensor.name == kLightStripe) {
    AddLightStripe(drive.sensors.light_stripe, sensor);
  }
  return sensor;
}

}  // namespace rockyard::campaign
