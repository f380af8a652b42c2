// A terrain sensor that no file of rockyard knows: it takes images and computes for as long as it
// is told to, and sees three points of level ground ahead.
#pragma once

#include "core/fields.h"
#include "math/pose.h"
#include "scenario/load.h"
#include "trial/clock/compute_profile.h"
#include "trial/counters/hazard_watch.h"
#include "trial/eyes/terrain_sensor.h"
#include "trial/eyes/terrain_sensor_set_params.h"

namespace rockyard::trial {

struct ToySensorParams {
  double imaging_s = 0.12;
  double computing_s = 0.2;
  // True poses at its looks, for one test at a time.
  std::shared_ptr<std::vector<math::Transform>> poses =
      std::make_shared<std::vector<math::Transform>>();

  void Visit(core::FieldVisitor& v) {
    v.Real("imaging_s", imaging_s, core::Assumed("time for images", {}, {0, 100}));
    v.Real("computing_s", computing_s, core::Assumed("time to compute", {}, {0, 100}));
  }
};

class ToySensor final : public TerrainSensor {
 public:
  explicit ToySensor(const ToySensorParams& params) : params_(params) {}

  LookData Look(const terrain::Terrain& /*terrain*/, const math::Transform& X_WR,
                messages::LookDirection direction, std::int64_t number) const override {
    if (direction == messages::LookDirection::kBehind) return {};
    params_.poses->push_back(X_WR);
    return messages::PointCloud{
        number, direction, {{0.5, -0.2, 0.0}, {0.5, 0.0, 0.0}, {0.5, 0.2, 0.0}}};
  }

 private:
  ToySensorParams params_;
};

class ToyReader final : public TerrainReader {
 public:
  messages::ElevationScan Elevations(const LookOrder& order,
                                     const LookData& /*data*/) const override {
    messages::ElevationScan scan;
    scan.number = order.number;
    for (messages::ElevationPoint& point : scan.points.points()) point.detected = true;
    return scan;
  }
  messages::PointCloud Points(const LookOrder& /*order*/, const LookData& data) const override {
    return std::get<messages::PointCloud>(data);
  }
};

class ToySensorKind final : public core::KindWithParams<TerrainSensorKind, ToySensorParams> {
 public:
  explicit ToySensorKind(ToySensorParams values)
      : KindWithParams("toy", "sees level ground", std::move(values)) {}

  std::unique_ptr<TerrainSensorKind> Clone() const override {
    return std::make_unique<ToySensorKind>(*this);
  }
  bool uses_computer() const override { return false; }
  bool takes_image_sets() const override { return true; }
  void Require(const DriveParams&, core::FieldVisitor& v) const override {
    v.Require("sensors.toy.computing_s", params.computing_s < 50.0, "is too long", "use less");
  }
  void RequireDrive(const DriveParams&, core::FieldVisitor&) const override {}
  ReportArray report_array(const DriveParams&) const override { return {5, "the toy has", "5"}; }
  Zone reported_zone(const DriveParams&) const override { return {0.3, 0.7, -0.3, 0.3}; }
  LookTime look_time(const DriveParams&, const ComputeTimes&) const override {
    return {.imaging_s = params.imaging_s, .computing_s = params.computing_s};
  }
  const sensing::StereoParams* cameras(const DriveParams&) const override { return nullptr; }
  std::unique_ptr<TerrainSensor> MakeSensor(const DriveParams&, core::TrialKey,
                                            RoverCameras&) const override {
    return std::make_unique<ToySensor>(params);
  }
  std::unique_ptr<TerrainReader> MakeReader(const DriveParams&,
                                            const SightWatchers&) const override {
    return std::make_unique<ToyReader>();
  }
};

inline scenario::Scenario WithToySensor(const ToySensorParams& params) {
  scenario::Scenario defaults;
  defaults.drive.sensors.terrain_sensors.Add(std::make_unique<ToySensorKind>(params));
  return defaults;
}

}  // namespace rockyard::trial
