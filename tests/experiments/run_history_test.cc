#include "experiments/three_rock_run/run_history.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "experiments/three_rock_traces.h"
#include "math/angles.h"

namespace rockyard::experiments {
namespace {

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
