// Rovers whose wheels slip, with a check of slip by what they see.

#include <gmock/gmock.h>

#include "math/angles.h"
#include "trial/referee/slip_onset.h"
#include "trial/shipped_trials.h"
#include "truth/end_cause.h"

namespace rockyard::trial {
namespace {

using truth::TrialOutcome;

constexpr std::string_view kEndedBySlip = truth::Info(truth::EndCause::kExcessiveSlip).sentence;

// Up a bare slope, straight to the goal; images every 10 cm.
DriveParams UpSlope(double slope_deg, const Overrides& more = {}) {
  const Overrides slope{"sensors.visual_odometry.enabled=true",
                        "localization.estimator=visual_odometry",
                        "sensors.visual_odometry.schedule.every_m=0.1",
                        "perception.visual_odometry.slip_check.enabled=true",
                        "rover.fidelity=quasi_static",
                        "terrain.arena.kind=open",
                        "terrain.rocks.kind=none",
                        "perception.hazard.enabled=false",
                        "referee.no_path_distance_m=null",
                        "course.goal_x_m=3",
                        "terrain.ground.slope_deg=" + std::to_string(slope_deg)};
  return Pathfinder("nominal", slope + more);
}

DriveResult DriveUp(double slope_deg, const Overrides& more = {}) {
  return RunTrial(UpSlope(slope_deg, more), {1, 0});
}

TEST(SlipDrive, EndsWhereItSlipsTooMuch) {
  const DriveResult steep = DriveUp(23.0);
  EXPECT_EQ(steep.detail, kEndedBySlip);
  EXPECT_EQ(steep.outcome, TrialOutcome::kExcessiveSlip);
  EXPECT_EQ(steep.record.slip_alarms, 1.0);
  EXPECT_EQ(steep.record.false_slip_alarms, 0.0);
  EXPECT_GT(steep.record.largest_slip, 0.5);
  // Not before it truly slipped, and within the way of two pairs of images of that.
  EXPECT_GE(steep.record.first_slip_alarm_m, steep.record.slip_onset_m - 0.05);
  EXPECT_LT(steep.record.first_slip_alarm_m, steep.record.slip_onset_m + 0.25);
}

TEST(SlipDrive, GoesOnWhereItDoesNot) {
  const DriveResult level = DriveUp(0.0);
  EXPECT_EQ(level.outcome, TrialOutcome::kGoalReached);
  EXPECT_EQ(level.record.slip_alarms, 0.0);
  EXPECT_LT(level.record.largest_slip, 0.3);
  EXPECT_TRUE(std::isnan(level.record.first_slip_alarm_m));
  EXPECT_TRUE(std::isnan(level.record.slip_onset_m));
}

// A limit below what every wheel on sand slips stops it on level ground, too; and without the check
// nobody knows.
TEST(SlipDrive, GoesByItsLimit) {
  const DriveResult strict = DriveUp(10.0, {"perception.visual_odometry.slip_check.limit=0.02"});
  EXPECT_EQ(strict.detail, kEndedBySlip);
  const DriveResult unchecked =
      DriveUp(23.0, {"perception.visual_odometry.slip_check.enabled=false"});
  EXPECT_NE(unchecked.detail, kEndedBySlip);
  EXPECT_TRUE(std::isnan(unchecked.record.largest_slip));
}

// Once in a drive, up a slope that is as steep everywhere.
TEST(SlipDrive, BacksOffWhereThatIsTheReaction) {
  const DriveResult backs = DriveUp(23.0, {"navigation.on_board_stuck.reaction=back_off",
                                           "navigation.on_slip.reaction=as_stuck"});
  EXPECT_EQ(backs.outcome, TrialOutcome::kExcessiveSlip);
  EXPECT_EQ(backs.record.slip_alarms, 2.0);
  EXPECT_EQ(backs.record.reversals, 2.0);  // back, and forward again
  EXPECT_EQ(backs.record.false_slip_alarms, 0.0);
}

// Who gives up by an alarm does so for the slip, whatever else makes it give up.
TEST(SlipDrive, GivesUpForTheSlip) {
  const DriveResult stop = DriveUp(23.0);
  const DriveResult as_stuck = DriveUp(
      23.0, {"navigation.on_board_stuck.reaction=give_up", "navigation.on_slip.reaction=as_stuck"});
  EXPECT_EQ(as_stuck.outcome, TrialOutcome::kExcessiveSlip);
  EXPECT_EQ(as_stuck.record.slip_alarms, 1.0);
  EXPECT_NEAR(as_stuck.record.true_distance_m, stop.record.true_distance_m, 0.03);
  const DriveResult exhausted =
      DriveUp(23.0, {"navigation.on_slip.reaction=replan", "navigation.on_slip.max_alarms=100",
                     "navigation.pathfinder.vehicle_reaction.progress_m=10",
                     "navigation.pathfinder.vehicle_reaction.max_repeats=1"});
  EXPECT_EQ(exhausted.outcome, TrialOutcome::kExcessiveSlip);
  EXPECT_EQ(exhausted.record.slip_alarms, 2.0);
}

TEST(SlipDrive, PlansAnewAsOftenAsItMay) {
  const auto replans = [](int most) {
    return DriveUp(23.0, {"navigation.on_slip.reaction=replan",
                          "navigation.on_slip.max_alarms=" + std::to_string(most)});
  };
  EXPECT_THAT(Differences(replans(0), DriveUp(23.0)), testing::IsEmpty());
  const DriveResult twice = replans(2);
  EXPECT_EQ(twice.outcome, TrialOutcome::kExcessiveSlip);
  EXPECT_EQ(twice.record.slip_alarms, 3.0);
  EXPECT_GE(twice.record.reversals, 2.0);
  EXPECT_GE(twice.record.turns_in_place, 2.0);
}

// Every alarm but the last, which ends the drive, begins a path of images anew: its first pair is
// taken and compared with nothing.
TEST(SlipDrive, ComparesNothingWithImagesFromBeforeAnAlarm) {
  const DriveResult drive =
      DriveUp(23.0, {"navigation.on_slip.reaction=replan", "navigation.on_slip.max_alarms=2",
                     "clock.compute.computer=mer_rad6000", "clock.compute.acquisition_s=10"});
  ASSERT_EQ(drive.record.slip_alarms, 3.0);
  EXPECT_NEAR(drive.record.imaging_time_s, 10.0 * (drive.record.visual_steps + 1.0 + 2.0), 1e-6);
}

// At a distance from the right mirror line, along it. All that is seen of 5 cm and more is an
// alarm, three are borne, and after two, forwards and backing off, the rover turns to the line.
DriveParams BesideMirrorLine(double distance_m) {
  const std::string y_m = std::to_string(distance_m - 1.5);
  return UpSlope(
      0.0, {"terrain.arena.kind=virtual_reflected", "terrain.arena.width_m=4",
            "terrain.arena.mirror_margin_m=0.5", "course.start_y_m=" + y_m,
            "course.goal_y_m=" + y_m, "clock.overlap.imaging=true", "clock.overlap.computing=true",
            "perception.visual_odometry.slip_check.limit=-1",
            "perception.visual_odometry.slip_check.min_way_m=0.05",
            "navigation.on_slip.reaction=replan", "navigation.on_slip.max_alarms=3"});
}

// The fourth alarm ends the drive, unless operators turn the rover at the line in the very tick: by
// where it starts some drives have a fifth and the others do not.
TEST(SlipDrive, OperatorsWhoTurnTheRoverDropItsAlarm) {
  int dropped = 0;
  int ended = 0;
  for (int i = 0; i <= 16; ++i) {
    const DriveResult drive = RunTrial(BesideMirrorLine(0.05 + 0.0025 * i), {1, 0});
    EXPECT_EQ(drive.outcome, TrialOutcome::kExcessiveSlip);
    if (drive.record.slip_alarms > 4.0) {
      EXPECT_GE(drive.record.reflections, 1.0);
      ++dropped;
    } else {
      EXPECT_EQ(drive.record.slip_alarms, 4.0);
      ++ended;
    }
  }
  EXPECT_GE(dropped, 1);
  EXPECT_GE(ended, 1);
}

// Half of the way is lost from x = 1 m on: the limit of a third is exceeded once a third of the
// last 0.3 m is, after the wheels have rolled 0.2 m more, of which 0.1 m is true.
TEST(SlipOnsetTest, IsWhereTheTrueSlipOverTheWindowExceedsTheLimit) {
  SlipOnset onset({.enabled = true, .limit = 1.0 / 3.0, .sigma = 0.0, .min_way_m = 0.3});
  messages::PoseEstimate odometry;
  math::Pose2 truth;
  for (int i = 0; i < 400; ++i) {
    odometry.x_m += 0.01;
    odometry.distance_m += 0.01;
    truth.x_m += truth.x_m < 1.0 ? 0.01 : 0.005;
    onset.Observe(odometry, truth, truth.x_m);
  }
  ASSERT_TRUE(onset.path_m());
  EXPECT_NEAR(*onset.path_m(), 1.1, 0.02);
}

// 2 m ahead and 1 m to the left of a rover that faces +y.
TEST(SlipOnsetTest, TrueMotionIsToldInTheFirstHeading) {
  const messages::RelativeMotion motion =
      TrueMotion({1.0, 2.0, math::DegToRad(90.0)}, {0.0, 4.0, 0.3});
  EXPECT_NEAR(motion.motion_F[0], 2.0, 1e-12);
  EXPECT_NEAR(motion.motion_F[1], 1.0, 1e-12);
  EXPECT_EQ(motion.covariance.norm(), 0.0);
}

TEST(SlipOnsetTest, KnowsNothingWhereSlipIsNotChecked) {
  SlipOnset onset({.enabled = false, .limit = 0.1, .sigma = 0.0, .min_way_m = 0.1});
  messages::PoseEstimate odometry;
  for (int i = 0; i < 100; ++i) {
    odometry.x_m += 0.01;
    odometry.distance_m += 0.01;
    onset.Observe(odometry, {}, 0.0);
  }
  EXPECT_FALSE(onset.path_m());
}

}  // namespace
}  // namespace rockyard::trial
