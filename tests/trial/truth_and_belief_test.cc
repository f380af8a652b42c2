// What a drive counts by the truth and not by what the rover believes, and what the rover's belief
// takes while it looks.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "math/angles.h"
#include "sensing/motion_sensors.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

// A blind drive past a high rock beside the way, where the odometer reads `scale` of the distance.
truth::DriveRecord DrivePastARock(const std::string& rock_x_m, const std::string& scale) {
  return RunTrial(Pathfinder(
                      "level_sand",
                      {"rover.fidelity=quasi_static", "sensors.gyro.heading_variance_deg2_per_m=0",
                       "terrain.rocks.kind=listed", "terrain.rocks.listed.x_m=[" + rock_x_m + "]",
                       "terrain.rocks.listed.y_m=[0.45]", "terrain.rocks.listed.diameter_m=[0.2]",
                       "terrain.rocks.listed.height_m=[0.3]",
                       "perception.dead_reckoning.distance_scale=" + scale}),
                  {1, 0})
      .record;
}

// Goals are 7 m or more ahead: a rover that believes in half of its way drives past 10 m, and one
// that believes in twice as much never comes to 6 m.
TEST(HazardsMetTest, AreThoseThatTheRoverTrulyComesTo) {
  const truth::DriveRecord beyond = DrivePastARock("10", "0.5");
  ASSERT_GT(beyond.final_x_m, 11.0);
  ASSERT_LT(beyond.believed_x_m, 9.0);
  EXPECT_EQ(beyond.hazards_met, 1.0);
  const truth::DriveRecord before = DrivePastARock("6", "2");
  ASSERT_LT(before.final_x_m, 5.0);
  ASSERT_GT(before.believed_x_m, 6.0);
  EXPECT_EQ(before.hazards_met, 0.0);
}

DriveParams Scanning(const std::string& accumulates_at_rest) {
  return Pathfinder("level_sand", {"rover.fidelity=quasi_static", "perception.hazard.enabled=true",
                                   "sensors.gyro.accumulates_at_rest=" + accumulates_at_rest});
}

// The gyro's drift over the looks of a straight drive, as the rover believes it: the mean square of
// what its heading changes by from before a look to the tick after it, less what it truly turned.
double MeanSquareDriftOfALook(const DriveParams& drive) {
  const TracedTrial trial = RunTraced(drive, 0);
  const std::vector<truth::TraceSample>& samples = trial.trace.samples;
  double sum_rad2 = 0.0;
  int looks = 0;
  for (const truth::TraceRest& rest : trial.trace.rests) {
    const std::size_t after = rest.samples_before;
    if (rest.sample.activity != "scan" || after == 0 || after >= samples.size()) continue;
    const truth::TraceSample& first = samples[after - 1];
    const truth::TraceSample& last = samples[after];
    const double drift_rad =
        math::WrapAngle(last.estimate.heading_rad - first.estimate.heading_rad) -
        drive.sensors.gyro.scale * math::WrapAngle(last.pose.heading_rad - first.pose.heading_rad);
    sum_rad2 += drift_rad * drift_rad;
    ++looks;
  }
  EXPECT_GE(looks, 60);
  return sum_rad2 / looks;
}

// A Wiener process of variance q a second grows by q times the 20 s of a scan where it goes on at
// rest, and otherwise by that of the tick after it at most. The mean of 60 squares or more is
// within a factor of 2 with a probability above 0.999 (chi squared).
TEST(LookDriftTest, TheGyroDriftsForTheTimeOfALookWhereItDriftsAtRest) {
  const DriveParams drive = Scanning("true");
  const double expected_rad2 = drive.sensors.gyro.heading_variance_rad2_per_s() * 20.0;
  const double drift_rad2 = MeanSquareDriftOfALook(drive);
  EXPECT_GT(drift_rad2, expected_rad2 / 2.0);
  EXPECT_LT(drift_rad2, expected_rad2 * 2.0);
}

TEST(LookDriftTest, ItDoesNotWhereItIsTiedToDriving) {
  const DriveParams drive = Scanning("false");
  const double tick_s = 1.0 / drive.clock.control_rate_hz;
  EXPECT_LT(MeanSquareDriftOfALook(drive),
            drive.sensors.gyro.heading_variance_rad2_per_s() * tick_s * 2.0);
}

// Looks at which nothing drifts draw no numbers either: the noise of every tick of driving is that
// of its number among the ticks of motion, however often the rover looked before.
TEST(LookDriftTest, LooksWithoutDriftShiftNoNoise) {
  const DriveParams drive = Scanning("false");
  const sensing::Gyro gyro(drive.sensors.gyro, {1, 0});
  const TracedTrial trial = RunTraced(drive, 0);
  const std::vector<truth::TraceSample>& samples = trial.trace.samples;
  int drives = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const truth::TraceSample& before = samples[i - 1];
    const truth::TraceSample& now = samples[i];
    const double drift_rad =
        math::WrapAngle(now.estimate.heading_rad - before.estimate.heading_rad) -
        drive.sensors.gyro.scale * math::WrapAngle(now.pose.heading_rad - before.pose.heading_rad);
    if (std::abs(drift_rad) < 1e-7) continue;  // at rest, or braking: rounding alone
    const double tick_s = 1.0 / drive.clock.control_rate_hz;
    EXPECT_NEAR(drift_rad, gyro.Measure(0.0, tick_s, true, static_cast<std::int64_t>(i)), 1e-6);
    ++drives;
  }
  EXPECT_GE(drives, 500);
}

}  // namespace
}  // namespace rockyard::trial
