// The slope of squared errors along a run: closed forms, and the columns against traced drives.
#include "trial/error_growth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/angles.h"
#include "trial/drive_monitor.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

TEST(ErrorGrowthTest, IsZeroWithoutAWay) {
  ErrorGrowth growth;
  EXPECT_EQ(growth.per_m(), 0.0);
  growth.Observe(0.0, 3.0);
  EXPECT_EQ(growth.per_m(), 0.0);
}

// e^2 = q x lies on a line through the origin, whatever the steps.
TEST(ErrorGrowthTest, IsTheSlopeOfALine) {
  ErrorGrowth growth;
  double x_m = 0.0;
  for (int i = 1; i <= 300; ++i) {
    x_m += 0.01 * (1 + i % 3);
    growth.Observe(x_m, (i % 2 == 0 ? 1.0 : -1.0) * std::sqrt(0.7 * x_m));
  }
  EXPECT_NEAR(growth.per_m(), 0.7, 1e-12);
}

// e = a x: the integral of x a^2 x^2 over that of x^2 is a^2 3 X / 4.
TEST(ErrorGrowthTest, OfAScaleErrorIsThreeQuartersOfTheEnd) {
  ErrorGrowth growth;
  for (int i = 1; i <= 70000; ++i) growth.Observe(1e-4 * i, 0.06 * 1e-4 * i);
  EXPECT_NEAR(growth.per_m(), 0.06 * 0.06 * 0.75 * 7.0, 1e-5 * 0.0189);
}

TEST(ErrorGrowthTest, ARoverThatStandsAddsNothing) {
  ErrorGrowth growth;
  growth.Observe(1.0, 2.0);
  for (int i = 0; i < 100; ++i) growth.Observe(1.0, 50.0);
  EXPECT_EQ(growth.per_m(), 4.0);
}

struct Slopes {
  double heading_deg2_per_m = 0.0;
  double distance_m2_per_m = 0.0;
};

// Least squares over the chords of a traced path; where operators set the rover back one begins.
Slopes SlopesOf(const truth::Trace& trace) {
  double way_m = 0.0;
  double heading = 0.0;
  double distance = 0.0;
  double weight = 0.0;
  double counted_m = 0.0;
  math::Pose2 start = trace.rests.front().sample.pose;
  math::Pose2 last = start;
  std::size_t rest = 0;
  const auto chord_m = [&] { return std::hypot(last.x_m - start.x_m, last.y_m - start.y_m); };
  for (std::size_t i = 0; i < trace.samples.size(); ++i) {
    for (; rest < trace.rests.size() && trace.rests[rest].samples_before <= i; ++rest) {
      if (!trace.rests[rest].set_back) continue;
      way_m += chord_m();
      start = trace.rests[rest].sample.pose;
    }
    const truth::TraceSample& sample = trace.samples[i];
    last = sample.pose;
    if (chord_m() < DriveMonitor::kChord_m) continue;
    way_m += chord_m();
    start = last;
    const double dx_m = way_m - counted_m;
    counted_m = way_m;
    const double heading_deg =
        math::RadToDeg(math::WrapAngle(sample.pose.heading_rad - sample.estimate.heading_rad));
    const double distance_m = way_m - sample.estimate.distance_m;
    heading += way_m * heading_deg * heading_deg * dx_m;
    distance += way_m * distance_m * distance_m * dx_m;
    weight += way_m * way_m * dx_m;
  }
  return {heading / weight, distance / weight};
}

// `share`: how near the columns come.
void ExpectColumnsOf(const TracedTrial& trial, double share) {
  const Slopes slopes = SlopesOf(trial.trace);
  const truth::DriveRecord& record = trial.result.record;
  EXPECT_GT(slopes.heading_deg2_per_m, 0.0);
  EXPECT_NEAR(record.heading_growth_deg2_per_m / slopes.heading_deg2_per_m, 1.0, share);
  EXPECT_NEAR(record.distance_growth_m2_per_m / slopes.distance_m2_per_m, 1.0, share);
}

TEST(ErrorGrowthColumnsTest, AreTheSlopesOfTheTracedErrors) {
  for (const std::uint32_t index : {0u, 1u, 2u}) {
    ExpectColumnsOf(RunTraced(Pathfinder("level_sand", {"rover.fidelity=quasi_static"}), index),
                    1e-9);
  }
}

// Errors go on over a reflection: it turns truth and belief alike. The chord that it closes takes
// the error of the tick after it.
TEST(ErrorGrowthColumnsTest, GoOnOverReflections) {
  const TracedTrial trial =
      RunTraced(Pathfinder("level_sand",
                           {"rover.fidelity=quasi_static", "terrain.arena.kind=virtual_reflected",
                            "course.start_heading_deg=20", "course.start_y_m=0.9",
                            "navigation.pathfinder.heading_deadband_deg=30"}),
                0);
  ASSERT_GT(trial.result.record.reflections, 0.0);
  ExpectColumnsOf(trial, 1e-5);
}

}  // namespace
}  // namespace rockyard::trial
