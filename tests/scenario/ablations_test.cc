#include "scenario/ablations.h"

#include <algorithm>
#include <set>

#include "core/json_text.h"
#include "core/refusals.h"
#include "scenario/load.h"
#include "scenario/shipped.h"

namespace rockyard::scenario {
namespace {

using Names = std::vector<std::string>;

Scenario Nominal(const std::vector<std::string>& overrides = {}) {
  return Shipped("pathfinder/nominal", overrides);
}

std::string ReasonOf(const Scenario& scenario, const Names& names) {
  return core::RefusalOf([&] { WithAblations(scenario, names); });
}

TEST(AblationsTest, EachHasANameASentenceAndSettings) {
  std::set<std::string_view> names;
  for (const Ablation& ablation : Ablations()) {
    EXPECT_TRUE(names.insert(ablation.name).second) << ablation.name;
    EXPECT_GT(ablation.sentence.size(), 10U) << ablation.name;
    EXPECT_FALSE(ablation.settings.empty()) << ablation.name;
  }
  EXPECT_EQ(names.size(), 6U);
}

TEST(AblationsTest, EachChangesAScenarioOnceAndThenIsInForce) {
  const Scenario nominal = Nominal({"course.designation.enabled=true"});
  for (const Ablation& ablation : Ablations()) {
    const Names names{std::string(ablation.name)};
    const AblatedScenario ablated = WithAblations(nominal, names);
    EXPECT_TRUE(ablated.idle.empty()) << ablation.name;
    EXPECT_NE(Fingerprint(ablated.scenario), Fingerprint(nominal)) << ablation.name;
    EXPECT_EQ(AblationsInForce(ablated.scenario), names);
    EXPECT_EQ(WithAblations(ablated.scenario, names).idle, names);
  }
}

TEST(AblationsTest, TheFourFunctionsAreIndependent) {
  const Scenario nominal = Nominal({"course.designation.enabled=true"});
  const Names forward{"perfect_designation", "perfect_localization", "perfect_sensing",
                      "perfect_path_selection"};
  const Names backward(forward.rbegin(), forward.rend());
  const AblatedScenario one = WithAblations(nominal, forward);
  EXPECT_EQ(Fingerprint(one.scenario), Fingerprint(WithAblations(nominal, backward).scenario));
  EXPECT_EQ(AblationsInForce(one.scenario), forward);
}

// An experiment that measures errors refuses to have them taken away: that is said to who asks for
// it.
TEST(AblationsTest, WhatTheExperimentRefusesIsNotInForce) {
  const Scenario measured = Shipped("stereo_sensing/range");
  const Names in_force = AblationsInForce(measured);
  EXPECT_EQ(std::count(in_force.begin(), in_force.end(), "perfect_sensing"), 0);
  EXPECT_NE(ReasonOf(measured, {"perfect_sensing"}).find("no errors to measure"),
            std::string::npos);
}

TEST(AblationsTest, OneWithoutEffectIsNamed) {
  EXPECT_EQ(WithAblations(Nominal(), Names{"perfect_designation", "no_slip"}).idle,
            Names{"perfect_designation"});
}

TEST(AblationsTest, ChangesResolvedDocumentsAndOthersAlike) {
  for (const Ablation& ablation : Ablations()) {
    core::JsonValue resolved = WriteScenario(Nominal());
    core::JsonValue written = core::ParseJson(
        R"({"terrain": {"rocks": {"k_per_m2": 0.00415, "pointedness": 0.8675}},
            "course": {"goal_x_m": 7.6},
            "referee": {"no_path_time_s": 0, "time_limit_s": 0}, "energy": {"battery_wh": 0},
            "sensors": {"gyro": {"level_sand_gain": 1.16},
                        "encoders": {"physics_variance_m2_per_m": 5.8e-07,
                                     "level_sand_gain": 0.9951}},
            "perception": {"dead_reckoning": {"distance_scale": 0.9951}}})",
        "test");
    ApplyAblation(resolved, ablation.name);
    ApplyAblation(written, ablation.name);
    EXPECT_EQ(Fingerprint(ReadScenario(resolved)), Fingerprint(ReadScenario(written)))
        << ablation.name;
  }
}

TEST(AblationsTest, PerfectSensingTakesEveryErrorOfTheSensorAway) {
  Scenario rough = Nominal({"sensors.light_stripe.column_noise_px=0.5",
                            "sensors.light_stripe.missed_probability=0.1",
                            "sensors.light_stripe.wrong_place_probability=0.01",
                            "sensors.light_stripe.outlier_persistence=0.5",
                            "perception.calibration.left_camera.pitch_deg=1",
                            "perception.calibration.stereo_rear.y_m=0.01",
                            "perception.calibration.drive.track_percent=2"});
  const Scenario perfect = WithAblations(rough, Names{"perfect_sensing"}).scenario;
  EXPECT_EQ(perfect.drive.sensors.light_stripe.column_noise_px, 0.0);
  EXPECT_EQ(perfect.drive.sensors.light_stripe.missed_probability, 0.0);
  EXPECT_EQ(perfect.drive.sensors.light_stripe.wrong_place_probability, 0.0);
  EXPECT_EQ(perfect.drive.sensors.light_stripe.outlier_persistence, 0.0);
  EXPECT_EQ(perfect.drive.sensors.stereo.fidelity, sensing::StereoFidelity::kIdeal);
  EXPECT_EQ(perfect.drive.perception.calibration.left_camera.pitch_rad, 0.0);
  EXPECT_EQ(perfect.drive.perception.calibration.stereo_rear.y_m, 0.0);
  // Wheels and steering are a matter of localization.
  EXPECT_EQ(perfect.drive.perception.calibration.drive.track_percent, 2.0);
}

// Neither scale nor variance nor gain of level sand is left.
TEST(AblationsTest, NoSlipLeavesNothingOfTheCalibration) {
  const Scenario rough =
      Nominal({"sensors.gyro.level_sand_gain=1.3", "sensors.encoders.level_sand_gain=0.92",
               "sensors.encoders.physics_variance_m2_per_m=1e-6",
               "perception.dead_reckoning.distance_scale=0.92"});
  const trial::DriveParams drive = WithAblations(rough, Names{"no_slip"}).scenario.drive;
  EXPECT_EQ(drive.sensors.gyro.level_sand_gain, 1.0);
  EXPECT_EQ(drive.sensors.encoders.level_sand_gain, 1.0);
  EXPECT_EQ(drive.sensors.encoders.physics_variance_m2_per_m, 0.0);
  EXPECT_EQ(drive.perception.dead_reckoning.distance_scale, 1.0);
  EXPECT_EQ(drive.sensors.gyro.heading_variance_rad2_per_s(),
            sensing::GyroParams{}.heading_variance_rad2_per_s());
}

TEST(AblationsTest, NamesWhatIsWrong) {
  EXPECT_NE(ReasonOf(Nominal(), {"perfect_localisation"}).find("perfect_localization"),
            std::string::npos);
  EXPECT_NE(ReasonOf(Nominal(), {"no_slip", "no_slip"}).find("twice"), std::string::npos);
  EXPECT_NE(ReasonOf(Nominal(), {"no_avoidance", "perfect_path_selection"}).find("undone"),
            std::string::npos);
  EXPECT_EQ(ReasonOf(Nominal(), {"no_avoidance", "no_slip"}), "");
}

}  // namespace
}  // namespace rockyard::scenario
