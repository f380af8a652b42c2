// What a drive counts by the truth and not by what the rover believes, and what the rover's belief
// takes while it looks.
#include <gtest/gtest.h>

#include <algorithm>

#include "math/angles.h"
#include "scenario/shipped.h"
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
  EXPECT_LT(MeanSquareDriftOfALook(drive), drive.sensors.gyro.heading_variance_rad2_per_s() *
                                               (1.0 / drive.clock.control_rate_hz) * 2.0);
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

// Looks at the ground come after the rover has come to rest, also where its ramps are long.

// The Pathfinder rover on Mars, simulated ten times faster than real, so that its motors take a
// second from rest to full speed: over half a metre of empty ground.
DriveParams SlowDrive() {
  const Overrides empty = {"terrain.rocks.kind=none", "course.goal_x_m=0.5"};
  return scenario::Shipped("mars/mfex_nominal", empty).drive;
}

// Way of the rim that has turned farthest.
double RimWay(const truth::TraceSample& from, const truth::TraceSample& to, double radius_m) {
  double farthest_rad = 0.0;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    farthest_rad = std::max(
        farthest_rad, std::abs(to.posture.wheel_angle_rad[i] - from.posture.wheel_angle_rad[i]));
  }
  return radius_m * farthest_rad;
}

// Wheels that were at rest while the rover looked have come by a t^2 / 2 after the first tick, half
// a step of the physics more for its rounding of time, and no farther: nothing of the motion before
// the look is left.
TEST(StopBeforeLook, WheelsStartFromRestAfterALook) {
  const DriveParams drive = SlowDrive();
  const TracedTrial trial = RunTraced(drive, 0);
  const rover::RoverParams& rover = drive.rover;
  const double step_s = rover.physics.time_scale * rover.physics.step_s;
  const double ramp_s = rover.physics.time_scale * rover.drive.ramp_s;
  const double acceleration_m_s2 = rover.drive.speed_m_s / ramp_s;
  int starts = 0;
  for (const truth::TraceRest& rest : trial.trace.rests) {
    if (rest.sample.activity != "scan" || rest.samples_before >= trial.trace.samples.size()) {
      continue;
    }
    const truth::TraceSample& first = trial.trace.samples[rest.samples_before];
    if (first.activity != "drive") continue;
    const double tick_s = 2.0 * step_s;
    ASSERT_LT(tick_s, 0.5 * ramp_s);
    const double rolled_m = RimWay(rest.sample, first, rover.geometry.wheel_radius_m);
    const double from_rest_m = 0.5 * acceleration_m_s2 * tick_s * (tick_s + step_s);
    EXPECT_NEAR(rolled_m, from_rest_m, 0.1 * from_rest_m) << first.time_s << " s";
    ++starts;
  }
  EXPECT_GE(starts, 3);
}

}  // namespace
}  // namespace rockyard::trial
