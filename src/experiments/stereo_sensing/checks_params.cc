#include "experiments/stereo_sensing/checks_params.h"

#include <algorithm>

#include "core/archive.h"
#include "core/error.h"
#include "navigation/navigator_traits_params.h"

namespace rockyard::experiments {
namespace {

// Whether the cameras can be built with that baseline.
bool HoldsStereoBaseline(sensing::StereoParams cameras, double baseline_m) {
  cameras.baseline_m = baseline_m;
  try {
    core::ReadParams(core::WriteParams(cameras), cameras);
  } catch (const core::UserError&) {
    return false;
  }
  return true;
}

void RequireScene(const trial::DriveParams& drive, core::FieldVisitor& v) {
  v.Require("terrain.ground.slope_deg", drive.terrain.ground.IsLevel(),
            "or roughness_rms_m is not 0, or there are ditches or pits, where the experiment puts "
            "the rover on level ground",
            "leave the ground flat");
  const terrain::RockFieldParams& rocks = drive.terrain.rocks;
  v.Require("terrain.rocks.pointedness",
            rocks.kind == terrain::RockFieldKind::kNone || rocks.pointedness == 0.0,
            "is above 0, where the experiment knows the true outlines of ellipsoids only", "use 0");
}

}  // namespace

void RequireStereoMeasurable(const StereoSensingParams& study, const trial::DriveParams& drive,
                             core::FieldVisitor& v) {
  v.Require("sensors.terrain_sensor", drive.sensors.terrain_sensors.chosen().name() == "stereo",
            "is not stereo, the sensor that the experiment stereo_sensing measures", "use stereo");
  const sensing::StereoParams& cameras = drive.sensors.stereo;
  v.Require("sensors.stereo.fidelity", cameras.fidelity != sensing::StereoFidelity::kIdeal,
            "is ideal, which has one eye and no errors to measure", "use image or error_model");
  v.Require("sensors.stereo.field_of_view",
            cameras.field_of_view == sensing::StereoFieldOfView::kFull,
            "is stripe, where the experiment counts every pixel", "use full");
  v.Require(
      "navigation.navigator",
      drive.navigation.navigators.chosen().traits().reads == navigation::LookReading::kPoints,
      "does not read points, where the experiment asks what the navigator's map makes of them",
      "use gestalt");
  RequireScene(drive, v);
  v.Require(
      "stereo_sensing.distances_m",
      study.distances_m.empty() || study.distances_m.back() <= cameras.max_range_m,
      "reaches beyond sensors.stereo.max_range_m, so that its last cells miss what is farther",
      "end the bins at max_range_m, or raise it");
  v.Require(
      "stereo_sensing.baselines_m",
      std::all_of(study.baselines_m.begin(), study.baselines_m.end(),
                  [&](double baseline_m) { return HoldsStereoBaseline(cameras, baseline_m); }),
      "has a baseline with which sensors.stereo cannot work",
      "use shorter baselines, or search larger disparities (max_disparity_px)");
}

}  // namespace rockyard::experiments
