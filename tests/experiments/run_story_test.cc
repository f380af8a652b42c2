#include "experiments/three_rock_run/run_story.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/check.h"
#include "experiments/three_rock_traces.h"
#include "math/angles.h"

namespace rockyard::experiments {
namespace {

// What happens at each rock of a drive as the published one is told; a test changes one thing.
struct Script {
  double to_a_m = 2.6;
  double turn_a_deg = 30.0;
  bool false_alarm = false;
  bool alarm_a = true;
  bool scrape_a = false;
  bool alarm_b = false;
  int scrapes_b = 1;
  double jump_b_deg = 10.0;
  bool alarm_c = true;
  double turn_c_deg = 20.0;
  bool scrape_c = true;
};

// A at 2.6 m, B 1.4 m on, C 2 m on, then 2.1 m to the end.
class ScriptedRun {
 public:
  explicit ScriptedRun(const Script& script) {
    drive_.Drive(1.0);
    if (script.false_alarm) drive_.Event("hazard");
    drive_.Drive(script.to_a_m - 1.0);
    Meet(script.alarm_a, script.scrape_a ? 1 : 0, 0.0);
    // The gyro tells of nothing but 5 of 6 degrees.
    drive_.Turn(script.turn_a_deg, 5.0 / 6.0).Drive(0.3).Turn(-script.turn_a_deg).Drive(1.1);
    Meet(script.alarm_b, script.scrapes_b, script.jump_b_deg);
    drive_.Drive(2.0);
    Meet(script.alarm_c, 0, 0.0);
    drive_.Turn(script.turn_c_deg).Drive(0.6);
    if (script.scrape_c) Scrape(5.0);
    drive_.Drive(1.5);
  }

  RunHistory history() const {
    return {drive_.trace(), rocks_, {0.3, 0.6, 0.4}, {-0.3, 0.3, 0.25}};
  }

 private:
  // A rock is 0.5 m ahead, where the array sees it.
  void Meet(bool alarm, int scrapes, double jump_deg) {
    const math::Pose2 at = drive_.pose();
    rocks_.push_back({at.x_m + 0.5 * std::cos(at.heading_rad),
                      at.y_m + 0.5 * std::sin(at.heading_rad), 0.2, 0.2});
    if (alarm) drive_.Event("hazard");
    for (int i = 0; i < scrapes; ++i) Scrape(jump_deg);
  }

  // Of the rock that the rover is at.
  void Scrape(double jump_deg) {
    drive_.Event("scrape");
    drive_.Jump(jump_deg).Drive(0.05);
  }

  TraceByHand drive_;
  std::vector<PlacedRock> rocks_;
};

const ThreeRockTold kTold;

FirstRockStory First(const Script& script, const ThreeRockTold& told = kTold) {
  return TellFirstRock(ScriptedRun(script).history(), told);
}
SecondRockStory Second(const Script& script, const ThreeRockTold& told = kTold) {
  return TellSecondRock(ScriptedRun(script).history(), told, true);
}
ThirdRockStory Third(const Script& script, double length_m = 8.1, bool arrived = true) {
  return TellThirdRock(ScriptedRun(script).history(), kTold, arrived, length_m);
}

TEST(FirstRockStoryTest, HoldsAsTold) { EXPECT_TRUE(First({}).AsTold(kTold)); }

TEST(FirstRockStoryTest, FailsWithEachOfItsConditions) {
  EXPECT_FALSE(First({.to_a_m = 2.2}).detected);
  EXPECT_FALSE(First({.to_a_m = 3.0}).detected);
  EXPECT_FALSE(First({.alarm_a = false}).detected);
  EXPECT_FALSE(First({.turn_a_deg = 0.0}).turned);
  EXPECT_TRUE(First({.turn_a_deg = -30.0}).turned);
  EXPECT_FALSE(First({.scrape_a = true}).unscraped);
  for (const Script& script : {Script{.to_a_m = 2.2}, Script{.turn_a_deg = 0.0},
                               Script{.scrape_a = true}, Script{.alarm_a = false}}) {
    EXPECT_FALSE(First(script).AsTold(kTold));
  }
}

TEST(FirstRockStoryTest, AsksForAFalseAlarmOnlyWhereTold) {
  ThreeRockTold told;
  told.false_alarm = true;
  EXPECT_FALSE(First({}, told).AsTold(told));
  EXPECT_TRUE(First({.false_alarm = true}, told).AsTold(told));
  EXPECT_TRUE(First({.false_alarm = true}).AsTold(kTold));
  EXPECT_FALSE(First({}).false_alarm);
}

TEST(SecondRockStoryTest, HoldsAsToldAndFailsWithEachOfItsConditions) {
  EXPECT_TRUE(Second({}).AsTold());
  EXPECT_FALSE(Second({.alarm_b = true}).unseen);
  EXPECT_FALSE(Second({.scrapes_b = 0}).scraped);
  EXPECT_FALSE(Second({.alarm_a = false}).scraped);
  EXPECT_FALSE(TellSecondRock(ScriptedRun({}).history(), kTold, false).AsTold());
  ThreeRockTold twice;
  twice.b_scrapes = 2;
  EXPECT_FALSE(Second({}, twice).scraped);
  EXPECT_TRUE(Second({.scrapes_b = 2}, twice).scraped);
}

TEST(ThirdRockStoryTest, HoldsAsToldAndFailsWithEachOfItsConditions) {
  EXPECT_TRUE(Third({}).AsTold());
  EXPECT_FALSE(Third({.alarm_c = false}).detected);
  EXPECT_FALSE(Third({.scrapes_b = 0}).detected);
  EXPECT_FALSE(Third({.turn_c_deg = 5.0}).turned);
  EXPECT_FALSE(Third({.turn_c_deg = 35.0}).turned);
  EXPECT_TRUE(Third({.turn_c_deg = -20.0}).turned);
  EXPECT_FALSE(Third({.scrape_c = false}).scraped);
  EXPECT_FALSE(Third({}, 8.1, false).AsTold());
  EXPECT_FALSE(Third({}, 7.5).length);
  EXPECT_FALSE(Third({}, 8.7).length);
  EXPECT_TRUE(Third({}, 8.5).length);
}

// The order of what happens counts, not only that it does.
TEST(StoryOrderTest, ScrapesAndAlarmsComeInTheToldOrder) {
  // B's alarm comes where A's is told.
  EXPECT_FALSE(First({.to_a_m = 1.2, .alarm_a = false, .alarm_b = true}).detected);
  const auto read = [](const TraceByHand& drive, const std::vector<PlacedRock>& rocks) {
    return RunHistory(drive.trace(), rocks, {0.3, 0.6, 0.4}, {-0.3, 0.3, 0.25});
  };
  TraceByHand drive;
  drive.Drive(1.0).Event("scrape").Drive(1.6).Event("hazard").Drive(1.0);
  const PlacedRock near{1.0, 0.4, 0.2, 0.2};
  const PlacedRock far{3.1, 0.0, 0.2, 0.2};
  const PlacedRock aside{0.0, 9.0, 0.2, 0.2};
  EXPECT_FALSE(TellSecondRock(read(drive, {far, near, aside}), kTold, true).scraped);
  TraceByHand late;
  late.Drive(1.0).Event("hazard").Drive(2.0).Event("scrape").Drive(1.0);
  EXPECT_FALSE(
      TellThirdRock(read(late, {aside, far, {1.5, 0.0, 0.2, 0.2}}), kTold, true, 8.1).detected);
  // The rock that is scraped first raises the alarm later.
  TraceByHand back;
  back.Drive(1.0).Event("scrape").Drive(0.5).Turn(180.0).Drive(0.8).Event("hazard").Drive(0.1);
  EXPECT_FALSE(
      TellThirdRock(read(back, {aside, aside, {0.3, 0.1, 0.2, 0.2}}), kTold, true, 8.1).scraped);
}

// Signs are those of the turn at A, so that a mirrored run has the same history.
TEST(HeadingStagesTest, AreThoseOfTheScript) {
  for (const double side : {1.0, -1.0}) {
    const Script script{.turn_a_deg = side * 30.0, .jump_b_deg = side * 12.0};
    const HeadingStages stages = StagesOf(ScriptedRun(script).history());
    EXPECT_NEAR(stages.after_a_deg, -5.0, 1e-9);
    EXPECT_NEAR(stages.after_b_deg, 7.0, 1e-9);
    EXPECT_NEAR(stages.at_c_deg, 7.0, 1e-9);
    EXPECT_NEAR(stages.after_c_deg, 7.0 + side * 5.0, 1e-9);
    EXPECT_NEAR(stages.final_deg, 7.0 + side * 5.0, 1e-9);
  }
}

TEST(HeadingStagesTest, AskForADriveThatWentAsTold) {
  EXPECT_ANY_THROW(StagesOf(ScriptedRun({.alarm_c = false}).history()));
  EXPECT_ANY_THROW(StagesOf(ScriptedRun({.scrape_c = false}).history()));
}

constexpr RoverZone kArray{0.3, 0.6, 0.4};
constexpr RoverZone kBody{-0.3, 0.3, 0.25};

RunHistory Read(const TraceByHand& drive, const std::vector<PlacedRock>& rocks) {
  return {drive.trace(), rocks, kArray, kBody};
}

TEST(GapToZoneTest, IsTheDistanceToTheRectangleLessTheRadius) {
  const math::Pose2 rover{1.0, 2.0, 0.5 * std::numbers::pi};  // looks along y
  // 0.4 m ahead of the front edge.
  EXPECT_NEAR(GapToZone({1.0, 2.7, 0.2, 0.1}, rover, kBody), 0.3, 1e-12);
  // To the left, which is towards -x.
  EXPECT_NEAR(GapToZone({0.5, 2.0, 0.2, 0.1}, rover, kBody), 0.15, 1e-12);
  // Off a rear corner by 3 and 4 tenths.
  EXPECT_NEAR(GapToZone({1.55, 1.3, 0.2, 0.1}, rover, kBody), 0.4, 1e-12);
  EXPECT_NEAR(GapToZone({1.1, 2.1, 0.2, 0.1}, rover, kBody), -0.1, 1e-12);
  // Half a metre to the left of a rover that looks 30 deg off x: (-sin, cos) / 2.
  const math::Pose2 oblique{0.0, 0.0, math::DegToRad(30.0)};
  EXPECT_NEAR(GapToZone({-0.25, 0.25 * std::numbers::sqrt3, 0.2, 0.1}, oblique, kBody), 0.15,
              1e-12);
}

TEST(RunHistoryTest, AddsUpThePathAndWrapsTheError) {
  TraceByHand drive;
  drive.Drive(1.0).Turn(175.0).Jump(10.0).Drive(0.5);
  const RunHistory history = Read(drive, {});
  EXPECT_NEAR(history.moments().back().path_m, 1.5, 1e-12);
  // The believed heading lies beyond 180 deg, so that a plain difference would be -350 deg.
  EXPECT_NEAR(math::RadToDeg(history.moments().back().heading_error_rad), 10.0, 1e-9);
  EXPECT_NEAR(history.At(0.72)->path_m, 0.75, 1e-12);
  EXPECT_FALSE(history.At(0.72)->turning);
  EXPECT_EQ(history.At(1.6), nullptr);
  EXPECT_EQ(history.At(0.0), history.moments().data());
}

TEST(RunHistoryTest, GivesAnAlarmToTheRockInTheArray) {
  TraceByHand drive;
  drive.Drive(1.0).Event("hazard");
  const double end_of_array_m = 1.6;
  const double radius_m = 0.1;
  const double reach_m = end_of_array_m + kAlarmReach_m + radius_m;
  const auto rock_at = [&](double x_m) {
    return Read(drive, {{0.0, 5.0, 0.2, 0.2}, {x_m, 0.0, 0.2, 0.2}}).alarms().front().rock;
  };
  EXPECT_EQ(rock_at(reach_m - 0.01), 1);
  EXPECT_EQ(rock_at(reach_m + 0.01), std::nullopt);
  // Nearer to the array than another one within reach.
  const auto alarms =
      Read(drive, {{1.45, 0.55, 0.2, 0.2}, {1.45, 0.45, 0.2, 0.2}, {1.45, -0.5, 0.2, 0.2}})
          .alarms();
  EXPECT_EQ(alarms.front().rock, 1);
  EXPECT_NEAR(alarms.front().path_m, 1.0, 1e-12);
}

TEST(RunHistoryTest, GivesAScrapeToTheNearestRockHoweverFar) {
  TraceByHand drive;
  drive.Drive(1.0).Event("scrape").Drive(1.0).Event("scrape").Event("felt").Drive(0.5);
  const RunHistory history = Read(drive, {{1.0, 0.6, 0.2, 0.2}, {2.0, -0.6, 0.2, 0.2}});
  ASSERT_EQ(history.scrapes().size(), 2U);
  EXPECT_TRUE(history.alarms().empty());
  EXPECT_EQ(history.Scrapes(0), 1);
  EXPECT_EQ(history.Scrapes(1), 1);
  EXPECT_EQ(history.Scrapes(2), 0);
  EXPECT_EQ(history.LastScrape(2), nullptr);
  // The tick after it, whose estimate holds the jump.
  EXPECT_NEAR(history.LastScrape(1)->path_m, 2.05, 1e-12);
}

TEST(RunHistoryTest, FindsTheFirstAlarmAndTheLastScrapeOfARock) {
  TraceByHand drive;
  drive.Drive(0.5).Event("hazard").Drive(0.1).Event("hazard").Drive(0.5).Event("scrape");
  drive.Drive(0.2).Event("scrape").Drive(0.2);
  const RunHistory history = Read(drive, {{1.1, 0.0, 0.2, 0.2}});
  ASSERT_NE(history.FirstAlarm(0), nullptr);
  EXPECT_NEAR(history.FirstAlarm(0)->path_m, 0.55, 1e-12);
  EXPECT_EQ(history.FirstAlarm(1), nullptr);
  EXPECT_NEAR(history.LastScrape(0)->path_m, 1.35, 1e-12);
}

TEST(RunHistoryTest, AnEventAtTheVeryEndBelongsToTheLastMoment) {
  TraceByHand drive;
  drive.Drive(1.0).Event("scrape");
  const RunHistory history = Read(drive, {{1.0, 0.3, 0.2, 0.2}});
  EXPECT_EQ(history.scrapes().front().moment, history.moments().size() - 1);
}

TEST(AvoidanceTurnTest, GoesOnOverShortDrivesAndEndsWithALongOne) {
  TraceByHand drive;
  drive.Drive(1.0).Event("hazard").Turn(30.0).Drive(kTurnChain_m - 0.05).Turn(10.0);
  drive.Drive(kTurnChain_m - 0.05).Turn(15.0);
  const std::size_t end = drive.trace().samples.size() - 1;
  drive.Drive(kTurnChain_m + 0.05).Turn(-20.0);
  const RunHistory history = Read(drive, {{1.5, 0.0, 0.2, 0.2}});
  const AvoidanceTurn turn = history.TurnAfter(history.alarms().front());
  EXPECT_NEAR(math::RadToDeg(turn.turned_rad), 55.0, 1e-9);
  EXPECT_EQ(turn.end, end);
}

TEST(AvoidanceTurnTest, OfARoverThatDrivesOnIsNone) {
  TraceByHand drive;
  drive.Drive(1.0).Event("hazard").Drive(0.5).Turn(30.0);
  const RunHistory history = Read(drive, {{1.5, 0.0, 0.2, 0.2}});
  const AvoidanceTurn turn = history.TurnAfter(history.alarms().front());
  EXPECT_EQ(turn.turned_rad, 0.0);
  EXPECT_EQ(turn.end, history.alarms().front().moment);
}

TEST(RunHistoryTest, OfNoDriveIsEmpty) {
  const RunHistory history(truth::Trace{}, {}, kArray, kBody);
  EXPECT_TRUE(history.moments().empty());
  EXPECT_EQ(history.At(0.0), nullptr);
}

}  // namespace
}  // namespace rockyard::experiments
