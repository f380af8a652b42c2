// The light stripe sensor as one of the kinds that scenarios can name (terrain_sensor_kinds.h).
#include <memory>

#include "rover/rover_layout_params.h"
#include "sensing/stripe_layout_params.h"
#include "trial/clock/compute_profile.h"
#include "trial/counters/hazard_watch.h"
#include "trial/drive_params.h"
#include "trial/eyes/stripe_eyes.h"
#include "trial/eyes/terrain_sensor_kinds.h"
#include "trial/sight/stripe_reader.h"

namespace rockyard::trial {
namespace {

void RequireFinder(const DriveParams& drive, core::FieldVisitor& v) {
  const sensing::LightStripeParams& sensor = drive.sensors.light_stripe;
  v.Require(
      "perception.stripe_finder.averaging_px",
      sensor.fidelity == sensing::Fidelity::kGeometric ||
          drive.perception.stripe_finder.averaging_px <=
              sensor.imager.averaging_rows + 2 * sensor.imager.margin_rows,
      "is more than the image lines that sensors.light_stripe.imager reads around a scanline, "
      "so that no point would ever be found",
      "use at most its averaging_rows plus twice its margin_rows");
}

// Refuses images in which the rover hides a point of flat ground; rays do not see the rover.
void RequireFreeView(const DriveParams& drive, core::FieldVisitor& v) {
  const sensing::LightStripeParams& sensor = drive.sensors.light_stripe;
  v.Require("sensors.light_stripe.fidelity",
            sensor.fidelity == sensing::Fidelity::kGeometric ||
                !sensing::IsHiddenBy(sensor, rover::BodyBoxes(drive.rover.geometry)),
            "is image, where chassis or solar panel hide a point on flat ground from a camera or a "
            "light emitter",
            "mount both below the front edge of the panel, as camera_height_m and "
            "emitter_height_m 0.25 do on Rocky 3.2, or ahead of it");
}

// The kind `light_stripe` of scenarios.
class LightStripe final : public TerrainSensorKind {
 public:
  LightStripe() : TerrainSensorKind("light_stripe", "light stripe hazard sensor") {}

  std::unique_ptr<TerrainSensorKind> Clone() const override { return LightStripeKind(); }
  bool has_params() const override { return false; }  // its group is sensors.light_stripe
  void Visit(core::FieldVisitor& /*v*/) override {}

  bool uses_computer() const override { return false; }
  bool takes_image_sets() const override { return false; }

  void Require(const DriveParams& drive, core::FieldVisitor& v) const override {
    RequireFinder(drive, v);
    RequireFreeView(drive, v);
  }
  void RequireDrive(const DriveParams& /*drive*/, core::FieldVisitor& /*v*/) const override {}

  ReportArray report_array(const DriveParams& drive) const override {
    const auto stripes = sensing::ArraySize(drive.sensors.light_stripe).stripes;
    return {static_cast<std::int64_t>(stripes), "sensors.light_stripe has",
            "name every stripe of a denser array, e.g. left [0, 1, 2, 3], centre [4], "
            "right [5, 6, 7, 8]"};
  }
  Zone reported_zone(const DriveParams& drive) const override {
    return ArrayZone(drive.sensors.light_stripe);
  }
  LookTime look_time(const DriveParams& drive, const ComputeTimes& /*times*/) const override {
    return {.scanning_s = ScanTime(drive.clock, drive.sensors.light_stripe)};
  }
  const sensing::StereoParams* cameras(const DriveParams& /*drive*/) const override {
    return nullptr;
  }

  std::unique_ptr<TerrainSensor> MakeSensor(const DriveParams& drive, core::TrialKey key,
                                            RoverCameras& /*cameras*/) const override {
    return std::make_unique<StripeEyes>(drive, key);
  }
  std::unique_ptr<TerrainReader> MakeReader(const DriveParams& drive,
                                            const SightWatchers& watchers) const override {
    return std::make_unique<StripeReader>(drive, watchers.scan);
  }
};

}  // namespace

std::unique_ptr<TerrainSensorKind> LightStripeKind() { return std::make_unique<LightStripe>(); }

}  // namespace rockyard::trial
