// The stereo cameras as one of the kinds that scenarios can name (terrain_sensor_kinds.h).
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string_view>

#include "math/functions.h"
#include "trial/clock/compute_profile.h"
#include "trial/counters/hazard_watch.h"
#include "trial/drive_checks_params.h"
#include "trial/eyes/stereo_eyes.h"
#include "trial/eyes/terrain_sensor_kinds.h"
#include "trial/sight/stereo_reader.h"

namespace rockyard::trial {
namespace {

// Refuses pointed rocks without images: rays work out the outlines of rocks in both eyes for
// ellipsoids.
void RequireRoundRocks(const DriveParams& drive, core::FieldVisitor& v) {
  const terrain::RockFieldParams& rocks = drive.terrain.rocks;
  v.Require("terrain.rocks.pointedness",
            rocks.kind == terrain::RockFieldKind::kNone || rocks.pointedness == 0.0 ||
                drive.sensors.stereo.fidelity == sensing::StereoFidelity::kImage,
            "is above 0 where sensors.terrain_sensor is stereo, whose rays see ellipsoids only",
            "use 0, sensors.stereo.fidelity image, or terrain_sensor light_stripe");
}

// Returns the distance from R's origin, straight ahead, up to which the cameras show level ground:
// the end of their range, or the upper edge of the image where it meets the ground before.
double GroundReach_m(const sensing::StereoParams& stereo) {
  const sensing::StereoMountParams& mount = stereo.front;
  const double range_m = std::sqrt(
      std::max(stereo.max_range_m * stereo.max_range_m - mount.height_m * mount.height_m, 0.0));
  const double upper_rad = mount.pitch_rad - 0.5 * stereo.vertical_fov_rad;
  const double image_m = upper_rad > 0.0 ? mount.height_m / math::Tan(upper_rad)
                                         : std::numeric_limits<double>::infinity();
  return mount.ahead_m + std::min(range_m, image_m);
}

// Returns the distance from which on the cameras show level ground: the lower edge of the image.
double GroundStart_m(const sensing::StereoParams& stereo) {
  const sensing::StereoMountParams& mount = stereo.front;
  const double lower_rad =
      std::min(mount.pitch_rad + 0.5 * stereo.vertical_fov_rad, 0.5 * std::numbers::pi);
  return mount.ahead_m + mount.height_m / math::Tan(lower_rad);
}

bool HoldsCameras(const rover::RoverGeometryParams& rover, double ahead_m) {
  return ahead_m >= -0.5 * rover.length_m && ahead_m <= rover.length_m;
}

void RequireCameras(const DriveParams& drive, core::FieldVisitor& v) {
  const rover::RoverGeometryParams& rover = drive.rover.geometry;
  const sensing::StereoParams& stereo = drive.sensors.stereo;
  constexpr std::string_view kElsewhere =
      "puts the cameras behind the rover or more than half its length beyond its end";
  constexpr std::string_view kMount =
      "use -length_m / 2 to length_m of rover.geometry, or the cameras of that rover "
      "(scenarios/sensors/stereo_*.json)";
  v.Require("sensors.stereo.front.ahead_m", HoldsCameras(rover, stereo.front.ahead_m), kElsewhere,
            kMount);
  v.Require("sensors.stereo.rear.ahead_m", HoldsCameras(rover, stereo.rear.ahead_m), kElsewhere,
            kMount);
}

// Requires that cameras see the array that the behaviour controller judges: a stripe whose first
// two rows are not seen is a hazard, so that an array beyond the view would stop every rover.
void RequireArray(const DriveParams& drive, core::FieldVisitor& v) {
  const sensing::StereoParams& stereo = drive.sensors.stereo;
  const perception::CloudElevationParams& array = drive.perception.cloud_elevations;
  v.Require("perception.cloud_elevations.far_m", array.far_m <= GroundReach_m(stereo) + kSame_m,
            "lies beyond the level ground that sensors.stereo shows (max_range_m, front)",
            "use a shorter array, a longer range, or cameras that look less far down");
  const double row_m = (array.far_m - array.near_m) / static_cast<double>(array.rows);
  v.Require("perception.cloud_elevations.near_m", array.near_m + row_m > GroundStart_m(stereo),
            "begins with a row of bins nearer than any ground that sensors.stereo shows (front)",
            "begin farther away, or use fewer rows");
  // Bins do not overlap: their points add up to no more than the pixels of an image.
  const double pixels = static_cast<double>(stereo.columns) * static_cast<double>(stereo.rows);
  const double needed =
      2.0 * static_cast<double>(array.stripes) * static_cast<double>(array.min_points);
  v.Require("perception.cloud_elevations.min_points", needed <= pixels,
            "asks for more points in the first two rows of bins than sensors.stereo has pixels "
            "(columns times rows), so that some stripe would always be a hazard",
            "use fewer points");
  const sensing::StripeWindowParams& window = stereo.stripe_window;
  v.Require("perception.cloud_elevations",
            stereo.field_of_view == sensing::StereoFieldOfView::kFull ||
                (array.near_m >= window.near_m - kSame_m && array.far_m <= window.far_m + kSame_m &&
                 array.half_width_m <= window.half_width_m + kSame_m),
            "reaches beyond sensors.stereo.stripe_window, where field_of_view is stripe",
            "use near_m, far_m and half_width_m of the window");
}

bool ReadsReports(const DriveParams& drive) {
  return drive.navigation.navigators.chosen().traits().reads ==
         navigation::LookReading::kHazardReport;
}

// The kind `stereo` of scenarios.
class StereoCameras final : public TerrainSensorKind {
 public:
  StereoCameras() : TerrainSensorKind("stereo", "stereo cameras ahead and behind") {}

  std::unique_ptr<TerrainSensorKind> Clone() const override { return StereoKind(); }
  bool has_params() const override { return false; }  // its group is sensors.stereo
  void Visit(core::FieldVisitor& /*v*/) override {}

  bool uses_computer() const override { return true; }
  bool takes_image_sets() const override { return true; }

  void Require(const DriveParams& drive, core::FieldVisitor& v) const override {
    RequireRoundRocks(drive, v);
  }
  void RequireDrive(const DriveParams& drive, core::FieldVisitor& v) const override {
    RequireCameras(drive, v);
    if (ReadsReports(drive)) RequireArray(drive, v);
  }

  ReportArray report_array(const DriveParams& drive) const override {
    return {drive.perception.cloud_elevations.stripes, "perception.cloud_elevations.stripes",
            "name every stripe of the array, from left to right"};
  }
  Zone reported_zone(const DriveParams& drive) const override {
    const perception::CloudElevationParams& array = drive.perception.cloud_elevations;
    return {0.5 * drive.rover.geometry.length_m, array.far_m, -array.half_width_m,
            array.half_width_m};
  }
  LookTime look_time(const DriveParams& drive, const ComputeTimes& times) const override {
    const double matching_s = ReadsImagesAlone(drive) ? 0.0 : times.stereo_s;
    return {.imaging_s = times.acquisition_s, .computing_s = matching_s};
  }
  const sensing::StereoParams* cameras(const DriveParams& drive) const override {
    return &drive.sensors.stereo;
  }

  std::unique_ptr<TerrainSensor> MakeSensor(const DriveParams& drive, core::TrialKey key,
                                            RoverCameras& cameras) const override {
    return std::make_unique<StereoEyes>(drive, key, cameras);
  }
  std::unique_ptr<TerrainReader> MakeReader(const DriveParams& drive,
                                            const SightWatchers& watchers) const override {
    return std::make_unique<StereoReader>(drive, watchers.stereo);
  }
};

}  // namespace

std::unique_ptr<TerrainSensorKind> StereoKind() { return std::make_unique<StereoCameras>(); }

}  // namespace rockyard::trial
