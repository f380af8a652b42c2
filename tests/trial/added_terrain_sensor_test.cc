// A terrain sensor that no file of rockyard knows looks in a trial.
#include <gmock/gmock.h>

#include <string>

#include "core/error.h"
#include "core/refusals.h"
#include "scenario/shipped.h"
#include "trial/shipped_trials.h"
#include "trial/toy_terrain_sensor.h"

namespace rockyard::trial {
namespace {

using testing::HasSubstr;

DriveParams WithToy(const ToySensorParams& params, const Overrides& overrides) {
  const Overrides all = kShortAndEmpty + Overrides{"rover.fidelity=quasi_static"} + overrides;
  return scenario::Shipped("gestalt/abundance", all, WithToySensor(params)).drive;
}

// Both readings of a look, by a map and by a behaviour controller: each look takes its time.
TEST(AddedTerrainSensor, ShowsTheGroundToEitherNavigator) {
  for (const char* navigator : {"gestalt", "pathfinder"}) {
    const ToySensorParams params;
    const DriveParams drive =
        WithToy(params, {"sensors.terrain_sensor=toy", "clock.compute.computer=none",
                         std::string("navigation.navigator=") + navigator});
    const DriveResult result = RunTrial(drive, {1, 0});
    const double looks = result.record.image_sets;
    EXPECT_EQ(result.outcome, truth::TrialOutcome::kGoalReached) << navigator << result.detail;
    EXPECT_GT(looks, 2.0) << navigator;
    EXPECT_EQ(looks, static_cast<double>(params.poses->size())) << navigator;
    EXPECT_NEAR(result.record.imaging_time_s, 0.12 * looks, 1e-9) << navigator;
    EXPECT_NEAR(result.record.compute_time_s, 0.2 * looks, 1e-9) << navigator;
    EXPECT_EQ(result.record.scans, 0.0) << navigator;
  }
}

TEST(AddedTerrainSensor, HasItsGroupAndItsConditionsInAScenario) {
  const auto problem = [](const Overrides& overrides) -> std::string {
    return core::RefusalOf([&] { WithToy({}, overrides); });
  };
  EXPECT_EQ(problem({"sensors.toy.computing_s=60"}), "");  // of a sensor that is not chosen
  EXPECT_THAT(problem({"sensors.terrain_sensor=toy", "sensors.toy.computing_s=60"}),
              HasSubstr("sensors.toy.computing_s"));
  EXPECT_THAT(problem({"sensors.toy.imaging_s=-1"}), HasSubstr("sensors.toy.imaging_s"));
  EXPECT_THAT(problem({"sensors.terrain_sensor=toi"}), HasSubstr("toy"));
}

TEST(AddedTerrainSensor, ANameOfAnotherGroupIsRefused) {
  class NamedGyro final : public TerrainSensorKind {
   public:
    NamedGyro() : TerrainSensorKind("gyro", "") {}
    bool has_params() const override { return false; }
    void Visit(core::FieldVisitor&) override {}
    std::unique_ptr<TerrainSensorKind> Clone() const override { return nullptr; }
    bool uses_computer() const override { return false; }
    bool takes_image_sets() const override { return false; }
    void Require(const DriveParams&, core::FieldVisitor&) const override {}
    void RequireDrive(const DriveParams&, core::FieldVisitor&) const override {}
    ReportArray report_array(const DriveParams&) const override { return {}; }
    Zone reported_zone(const DriveParams&) const override { return {}; }
    LookTime look_time(const DriveParams&, const ComputeTimes&) const override { return {}; }
    const sensing::StereoParams* cameras(const DriveParams&) const override { return nullptr; }
    std::unique_ptr<TerrainSensorModel> Make(const DriveParams&, core::TrialKey,
                                             const Watchers&) const override {
      return nullptr;
    }
  };
  TerrainSensorSet sensors = StandardTerrainSensors();
  EXPECT_THROW(sensors.Add(std::make_unique<NamedGyro>()), core::UserError);
  EXPECT_THROW(sensors.Add(StandardTerrainSensors().Named("stereo").Clone()), core::UserError);
}

}  // namespace
}  // namespace rockyard::trial
