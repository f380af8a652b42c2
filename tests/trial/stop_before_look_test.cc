// Looks at the ground come after the rover has come to rest, also where its ramps are long.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenario/shipped.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

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
