// Aids of localization in a drive.

#include "trial/aids/aid_suite.h"

#include "core/refusals.h"
#include "trial/course/goal_designation.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using testing::HasSubstr;

TEST(AidSchedule, IsDueOnceAnInterval) {
  AidSchedule by_way({.enabled = true, .every_m = 2.5});
  EXPECT_FALSE(by_way.IsDue(0.0, 0.0));
  EXPECT_FALSE(by_way.IsDue(2.4, 100.0));
  EXPECT_TRUE(by_way.IsDue(2.6, 100.0));
  EXPECT_FALSE(by_way.IsDue(2.7, 100.0));
  EXPECT_TRUE(by_way.IsDue(5.0, 100.0));
  EXPECT_TRUE(by_way.IsDue(13.0, 100.0));  // two were passed in one tick: once
  EXPECT_FALSE(by_way.IsDue(14.0, 100.0));
  AidSchedule by_both({.enabled = true, .every_m = 10.0, .every_s = 60.0});
  EXPECT_TRUE(by_both.IsDue(1.0, 61.0));
  EXPECT_TRUE(by_both.IsDue(10.5, 62.0));
  EXPECT_FALSE(by_both.IsDue(10.6, 63.0));
  AidSchedule off({.enabled = false, .every_m = 1.0});
  EXPECT_FALSE(off.IsDue(50.0, 50.0));
}

TEST(LanderPlaceOf, StandsAboutTheLineToTheGoal) {
  CourseParams course;
  course.start_x_m = 1.0;
  course.start_y_m = 2.0;
  course.goal_x_m = 1.0;
  course.goal_y_m = 12.0;  // along +y
  course.designation.lander_ahead_m = -3.0;
  course.designation.lander_left_m = 0.5;
  const sensing::LanderPlace lander = LanderPlaceOf(course, {1, 0});
  EXPECT_NEAR(lander.x_m, 0.5, 1e-12);
  EXPECT_NEAR(lander.y_m, -1.0, 1e-12);
  EXPECT_EQ(lander.pan_error_rad, 0.0);
  course.designation.enabled = true;
  EXPECT_NEAR(LanderPlaceOf(course, {1, 0}).pan_error_rad, math::DegToRad(1.0), 1e-12);
  course.designation.pan_kind = PanError::kUniform;
  const double drawn = LanderPlaceOf(course, {1, 0}).pan_error_rad;
  EXPECT_LT(std::abs(drawn), math::DegToRad(1.0));
  EXPECT_NE(drawn, LanderPlaceOf(course, {1, 1}).pan_error_rad);
}

DriveParams WithAids(const Overrides& more) {
  const Overrides filter{"localization.estimator=error_state", "terrain.arena.kind=open",
                         "rover.fidelity=quasi_static"};
  return Pathfinder("nominal", filter + more);
}

// A lander without errors, every metre: the rover ends where it believes to be.
TEST(AidSuite, LeadsTheRoverWhereItIsTold) {
  const Overrides exact{"sensors.aids.lander_fix.enabled=true",
                        "sensors.aids.lander_fix.every_m=0.5",
                        "sensors.aids.lander_fix.heading_sd_deg=0.1",
                        "sensors.aids.lander_fix.range_sd_fraction=0.001"};
  double with_m = 0.0;
  double without_m = 0.0;
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    const DriveResult aided = RunTrial(WithAids(exact), {9, trial});
    const DriveResult alone = RunTrial(WithAids({}), {9, trial});
    with_m += aided.record.position_error_m / 20.0;
    without_m += alone.record.position_error_m / 20.0;
    EXPECT_GT(aided.record.aids_used + aided.record.aids_gated_out, 8.0);
    EXPECT_EQ(alone.record.aids_used, 0.0);
  }
  EXPECT_LT(with_m, 0.15);
  EXPECT_GT(without_m, 0.4);
}

// Where no aid is on, the filter changes nothing that dead reckoning does.
TEST(AidSuite, FilterAloneDrivesAsDeadReckoningDoes) {
  for (std::uint32_t trial = 0; trial < 3; ++trial) {
    const auto filter = RunTrial(WithAids({}), {1, trial});
    const auto flown = RunTrial(WithAids({"localization.estimator=dead_reckoning"}), {1, trial});
    std::vector<std::string> names = Differences(filter, flown);
    EXPECT_THAT(names,
                testing::UnorderedElementsAre("believed_position_sd_m", "believed_heading_sd_deg",
                                              "pose_nees", "inside_95"));
    EXPECT_TRUE(std::isnan(flown.record.pose_nees));
    EXPECT_GT(filter.record.believed_position_sd_m, 0.1);
  }
}

// By the law of the cylinder, found above 30 deg of sun alone. Of three drives one begins at noon,
// one soon after sunrise, and one has no sun of its own and reckons with 60 deg.
TEST(AidSuite, TellsTheLanderOfTheSun) {
  const auto aids_used = [](const Overrides& sun) {
    const Overrides lander{"sensors.aids.lander_fix.enabled=true",
                           "sensors.aids.lander_fix.every_m=1",
                           "sensors.aids.lander_fix.law=cylinder",
                           "sensors.aids.lander_fix.cylinder.found.intercept=-500",
                           "sensors.aids.lander_fix.cylinder.found.width=0",
                           "sensors.aids.lander_fix.cylinder.found.light=1000",
                           "sensors.aids.lander_fix.cylinder.wrong.intercept=-1000",
                           "sensors.aids.sun.every_m=10000"};
    return RunTrial(WithAids(lander + sun), {1, 0}).record.aids_used;
  };
  EXPECT_GT(aids_used({"sensors.aids.sun.enabled=true", "sensors.aids.sun.start_solar_time_h=12"}),
            0.0);
  EXPECT_EQ(aids_used({"sensors.aids.sun.enabled=true", "sensors.aids.sun.start_solar_time_h=6.5"}),
            0.0);
  EXPECT_GT(aids_used({"sensors.aids.sun.start_solar_time_h=6.5"}), 0.0);
}

// What is late corrects all the same, and less where it never arrives.
TEST(AidSuite, DataThatAreLateAreUsedWhenTheyArrive) {
  const Overrides late{"sensors.aids.sun.enabled=true", "sensors.aids.sun.delay_s=30"};
  const Overrides never{"sensors.aids.sun.enabled=true", "sensors.aids.sun.delay_s=1e6"};
  EXPECT_GT(RunTrial(WithAids(late), {1, 0}).record.aids_used, 3.0);
  const auto lost = RunTrial(WithAids(never), {1, 0});
  EXPECT_EQ(lost.record.aids_used, 0.0);
  EXPECT_EQ(lost.record.aids_unanswered, 0.0);
}

TEST(AidSuite, CountsWhatFoundNothing) {
  const auto hidden = RunTrial(
      WithAids({"sensors.aids.lander_fix.enabled=true", "sensors.aids.lander_fix.every_m=1",
                "sensors.aids.lander_fix.range_m=3.5"}),
      {1, 0});
  EXPECT_GE(hidden.record.aids_unanswered, 3.0);
  EXPECT_GE(hidden.record.aids_used, 2.0);
  EXPECT_LE(hidden.record.aids_used, 4.0);
}

TEST(AidSuite, IsRefusedWhereNobodyListens) {
  EXPECT_THAT(core::RefusalOf([] { Pathfinder("nominal", {"sensors.aids.sun.enabled=true"}); }),
              testing::AllOf(HasSubstr("localization.estimator"), HasSubstr("error_state")));
  EXPECT_THAT(core::RefusalOf([] {
                WithAids({"sensors.aids.beacon.enabled=true", "sensors.aids.beacon.every_m=0"});
              }),
              HasSubstr("sensors.aids.beacon.every_m"));
}

// One pan axis serves both: the rover ends where goals are told, not beside them by the pan error.
TEST(AidSuite, SharesThePanErrorOfDesignatedGoals) {
  const Overrides common{"course.designation.enabled=true",
                         "course.designation.pan_error_deg=4",
                         "sensors.aids.lander_fix.enabled=true",
                         "sensors.aids.lander_fix.every_m=0.5",
                         "sensors.aids.lander_fix.range_sd_fraction=0.001",
                         "terrain.rocks.kind=none",
                         "course.goal_radius_m=2"};
  const Overrides apart{"sensors.aids.lander_fix.shares_pan_error=false"};
  const auto shared = RunTrial(WithAids(common), {1, 0});
  const auto own = RunTrial(WithAids(common + apart), {1, 0});
  // 4 deg at 7.6 m are 0.53 m.
  EXPECT_LT(shared.record.true_goal_distance_m, 0.25);
  EXPECT_GT(own.record.true_goal_distance_m, 0.35);
  // It began at a known place of the world, so that the first fixes tell the pan angle: the rover
  // knows where it is in either frame, half a metre apart.
  for (const truth::DriveRecord& record : {shared.record, own.record}) {
    EXPECT_LT(record.position_error_m, 0.15);
    EXPECT_EQ(record.inside_95, 1.0);
  }
  EXPECT_GT(std::hypot(shared.record.believed_x_m - shared.record.final_x_m,
                       shared.record.believed_y_m - shared.record.final_y_m),
            0.35);
}

// In the mirrored arena nobody measures where the rover is turned: its belief stays as wide.
TEST(AidSuite, ReflectionsTellTheFilterNothing) {
  const Overrides narrow{"localization.estimator=error_state", "rover.fidelity=quasi_static",
                         "course.start_heading_deg=50", "terrain.rocks.kind=none"};
  const DriveResult drive = RunTrial(Pathfinder("nominal", narrow), {1, 0});
  const DriveResult open =
      RunTrial(Pathfinder("nominal", narrow + Overrides{"terrain.arena.kind=open"}), {1, 0});
  EXPECT_NEAR(drive.record.believed_heading_sd_deg, open.record.believed_heading_sd_deg, 0.6);
}

}  // namespace
}  // namespace rockyard::trial
