// The computer and sensor profiles: what a scan takes with each, and that a scenario can name one.
#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <string>

#include "core/refusals.h"
#include "scenario/load.h"
#include "trial/clock/power.h"
#include "trial/eyes/compute_profile.h"

namespace rockyard::trial {
namespace {

const std::filesystem::path kScenarios = std::filesystem::path(ROCKYARD_SOURCE_DIR) / "scenarios";

DriveParams With(const std::string& profile) {
  return scenario::ParseScenario(R"({"extends": ["mars/mfex_nominal.json", "sensors/profile_)" +
                                     profile + R"(.json"]})",
                                 {}, kScenarios)
      .drive;
}

TEST(SensorProfileTest, ScansTakeWhatTheirPartsTake) {
  struct Scan {
    double time_s, power_W;
  };
  constexpr double kLaser_W = 2.01 / 2.0;
  constexpr double kRest_W = 7.33 - 2.01;
  // T = 2 + 18 groups / 3 / speed; nine stripes two at a time are five groups.
  const std::map<std::string, Scan> expected{
      {"mfex_8085", {20.0, 7.33}},
      {"cmos", {2.0 + 18.0 / 10.0, 7.33 - 0.9 * 0.75}},
      {"all_lasers_at_once", {2.0 + 18.0 / 3.0, kRest_W + 5.0 * kLaser_W}},
      {"three_scanline_fan", {2.0 + 18.0 / 3.0, kRest_W + 20.0 * 0.01 * kLaser_W}},
      {"dense_array", {2.0 + 18.0 * 5.0 / 3.0, 7.33}}};
  for (const auto& [profile, scan] : expected) {
    const DriveParams drive = With(profile);
    EXPECT_NEAR(ScanTime(drive.clock, drive.sensors.light_stripe), scan.time_s, 1e-12) << profile;
    EXPECT_NEAR(MakePowerBudget(drive).Power(Activity::kScanning), scan.power_W, 1e-12) << profile;
  }
}

TEST(SensorProfileTest, EveryStripeOfADenserArrayNeedsASide) {
  // Nine stripes, five of them named.
  EXPECT_THAT(
      core::ProblemsIn([] {
        scenario::ParseScenario(R"({"sensors": {"light_stripe": {"stripe_subdivision": 2}}})");
      }),
      core::OneProblem("navigation.pathfinder.left_stripes", "another number of stripes"));
}

TEST(SensorProfileTest, WrongTimesAndPowersAreNamed) {
  const std::map<std::string, std::string> wrong{
      {"clock.scan_fixed_s", "21"},
      {"clock.scan_speed_factor", "0"},
      {"energy.laser_supply_efficiency", "0"},
      {"energy.imaging_W", "-1"},
      {"perception.vehicle_hazard.max_tilt_deg", "0"},
      {"perception.vehicle_hazard.tilt_ticks", "0"},
      {"navigation.pathfinder.vehicle_reaction.back_off_m", "0"},
      {"referee.hazard_height_m", "-0.1"}};
  for (const auto& [path, value] : wrong) {
    const std::vector<std::string> overrides{path + "=" + value};
    EXPECT_THAT(core::ProblemsIn([&] { scenario::ParseScenario("{}", overrides); }),
                core::OneProblem(path, ""));
  }
}

}  // namespace
}  // namespace rockyard::trial
