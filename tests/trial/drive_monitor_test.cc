// True path, tilt, turning and clearance of a drive, tick by tick.

#include "trial/counters/drive_monitor.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "trial/drive/drive_observer.h"
#include "trial/drive/make_estimator.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

constexpr Underside kUnderside{0.0, 0.2, 0.1, 0.13};

truth::RoverState At(double x_m, double y_m, double heading_rad = 0.0, double pitch_rad = 0.0) {
  truth::RoverState state;
  state.X_WR.translation() = math::Vector3(x_m, y_m, 0.0);
  state.X_WR.linear() = (Eigen::AngleAxisd(heading_rad, math::Vector3::UnitZ()) *
                         Eigen::AngleAxisd(pitch_rad, math::Vector3::UnitY()))
                            .toRotationMatrix();
  return state;
}

terrain::Terrain OneRock() {
  terrain::Rock rock{.center_W = {1.2, 0.1, 0.0}, .semi_axes_m = {0.06, 0.05, 0.09}};
  return {terrain::Ground(), {rock}, {}};
}

class DriveMonitorTest : public testing::Test {
 protected:
  truth::DriveRecord Report() const {
    truth::DriveRecord record;
    monitor_.Report(record);
    return record;
  }

  const terrain::Terrain terrain_ = OneRock();
  DriveMonitor monitor_{kUnderside, terrain_};
};

TEST_F(DriveMonitorTest, StartsWithoutTravel) {
  monitor_.Restart(At(3.0, 2.0));
  EXPECT_EQ(Report().true_distance_m, 0.0);
  EXPECT_EQ(Report().turned_in_place_rad, 0.0);
  EXPECT_EQ(Report().max_tilt_deg, 0.0);
}

TEST_F(DriveMonitorTest, StraightDriveIsItsLength) {
  monitor_.Restart(At(0.0, 0.0));
  for (int i = 1; i <= 301; ++i) monitor_.Observe(At(0.0, 0.0075 * i), false);
  EXPECT_NEAR(Report().true_distance_m, 301 * 0.0075, 1e-12);
}

TEST_F(DriveMonitorTest, JitterIsNoTravelAndAHandIsNone) {
  monitor_.Restart(At(0.0, 0.0));
  for (int i = 1; i <= 100; ++i) monitor_.Observe(At(0.004 * (i % 2), 0.0), false);
  EXPECT_NEAR(Report().true_distance_m, 0.0, 1e-12);
  monitor_.Restart(At(5.0, 0.0));
  EXPECT_NEAR(Report().true_distance_m, 0.0, 1e-12);
}

// Two legs of 3 and 4 m lead 5 m away; a hand that turns the rover on the way changes nothing.
TEST_F(DriveMonitorTest, DisplacementIsStraightFromTheFirstStart) {
  monitor_.Restart(At(1.0, 1.0));
  EXPECT_EQ(Report().displacement_m, 0.0);
  for (int i = 1; i <= 300; ++i) monitor_.Observe(At(1.0 + 0.01 * i, 1.0), false);
  monitor_.Restart(At(4.0, 1.0, 1.5));
  for (int i = 1; i <= 400; ++i) monitor_.Observe(At(4.0, 1.0 + 0.01 * i), false);
  EXPECT_NEAR(Report().displacement_m, 5.0, 1e-12);
  EXPECT_NEAR(Report().true_distance_m, 7.0, 1e-9);
}

TEST_F(DriveMonitorTest, CountsTurnsInPlaceOnlyAndBothWays) {
  monitor_.Restart(At(0.0, 0.0, 3.1));
  monitor_.Observe(At(0.0, 0.0, 3.2), true);  // across half a turn
  monitor_.Observe(At(0.0, 0.0, 3.3), false);
  monitor_.Observe(At(0.0, 0.0, 3.1), true);
  EXPECT_NEAR(Report().turned_in_place_rad, 0.1 + 0.2, 1e-12);
}

TEST_F(DriveMonitorTest, KeepsTheLargestTilt) {
  monitor_.Restart(At(0.0, 0.0));
  for (const double pitch_rad : {0.1, -0.3, 0.2}) monitor_.Observe(At(0, 0, 1.0, pitch_rad), false);
  EXPECT_NEAR(Report().max_tilt_deg, math::RadToDeg(0.3), 1e-9);
}

// Nine points of the belly against the terrain's height, the plain way.
TEST_F(DriveMonitorTest, ClearanceIsTheLeastOfNinePoints) {
  monitor_.Restart(At(0.0, 0.0));
  double min_m = kUnderside.height_m;
  for (int i = 0; i <= 200; ++i) {
    const truth::RoverState state = At(0.01 * i, 0.03, 0.002 * i, 0.001 * i);
    monitor_.Observe(state, false);
    for (const double x : {-0.2, 0.0, 0.2}) {
      for (const double y : {-0.1, 0.0, 0.1}) {
        const math::Vector3 p_W = state.X_WR * math::Vector3(x, y, kUnderside.height_m);
        min_m = std::min(min_m, p_W.z() - terrain_.Height(p_W.x(), p_W.y()));
      }
    }
    EXPECT_EQ(Report().min_clearance_m, min_m) << i;
  }
  EXPECT_LT(min_m, 0.06);  // it drove over the rock
}

// A rock of 40 cm, 30 cm high, within reach of the array of a rover at x = 1.
const Overrides kRockAhead = {
    "terrain.rocks.kind=listed",           "terrain.rocks.listed.x_m=[1.6]",
    "terrain.rocks.listed.y_m=[0.0]",      "terrain.rocks.listed.diameter_m=[0.4]",
    "terrain.rocks.listed.height_m=[0.3]", "terrain.rocks.clear_radius_m=0",
    "rover.fidelity=quasi_static"};

class DriveObserverTest : public testing::Test {
 protected:
  DriveObserverTest() {
    world_.Begin();
    onboard_.Begin(MakeEstimator(drive_, world_.rover(), nullptr));
    observer_.OnPlaced();
  }

  // The rover goes straight to x, y = `y_m`.
  void GoTo(double x_m, double y_m = 0.0) {
    world_.Place({x_m, y_m, 0.0});
    observer_.OnTick(false);
  }
  // It looks there, and is told whether a hazard is ahead.
  void Look(bool hazard) {
    observer_.OnSeen(0);
    observer_.OnReport(hazard, 0);
  }
  truth::DriveRecord Report() const { return observer_.Report(false, {}, referee_); }

  const DriveParams drive_ = Pathfinder("nominal", kRockAhead);
  World world_{drive_, {1, 0}};
  const std::vector<messages::Goal> told_ = drive_.course.Goals();
  Onboard onboard_{drive_, world_.key(), told_,
                   drive_.navigation.navigators.chosen().Make({.goal = told_.front()}),
                   world_.ramp_s()};
  Ledger ledger_{MakePowerBudget(drive_), drive_.energy.battery_wh};
  Referee referee_{drive_.referee, drive_.course, told_.front(), std::nullopt,
                   drive_.rover.geometry.wheel_radius_m};
  DriveObserver observer_{world_, onboard_, ledger_, told_};
};

TEST_F(DriveObserverTest, AReportOfAHazardCreditsTheRocksWithinReach) {
  GoTo(1.0);
  Look(true);
  GoTo(1.6);
  EXPECT_EQ(Report().hazards_met, 1.0);
  EXPECT_EQ(Report().hazards_missed, 0.0);
  EXPECT_EQ(Report().hazards_believed, 1.0);
}

TEST_F(DriveObserverTest, AReportWithoutOneCreditsNone) {
  GoTo(1.0);
  Look(false);
  GoTo(1.6);
  EXPECT_EQ(Report().hazards_met, 1.0);
  EXPECT_EQ(Report().hazards_missed, 1.0);
  EXPECT_EQ(Report().hazards_believed, 0.0);
}

// Data that arrive late are of the place where they were taken.
TEST_F(DriveObserverTest, AReportCreditsWhatWasInReachWhereItWasTaken) {
  GoTo(0.0);
  observer_.OnSeen(0);
  GoTo(1.0);
  observer_.OnReport(true, 0);
  GoTo(1.6);
  EXPECT_EQ(Report().hazards_missed, 1.0);
}

TEST_F(DriveObserverTest, TheFirstScrapeIsWhereItWas) {
  const double start_m = drive_.course.start_x_m;
  GoTo(start_m, 0.5);
  EXPECT_NEAR(Report().first_scrape_distance_m, 0.5, 1e-9);  // none: the whole way
  observer_.OnScrape();
  GoTo(start_m, 1.5);
  observer_.OnScrape();
  EXPECT_NEAR(Report().true_distance_m, 1.5, 1e-9);
  EXPECT_NEAR(Report().first_scrape_distance_m, 0.5, 1e-9);
}

// A third of a second at 60 deg/s is enough for either way; the middle wheels have no motor.
TEST_F(DriveObserverTest, SteeringIsThatOfTheTrueMotorsAtRestToo) {
  const auto steer_to = [&](double left_rad, double right_rad) {
    messages::WheelCommand command;
    command.steer_rad = {left_rad, left_rad, left_rad, right_rad, right_rad, right_rad};
    for (int tick = 0; tick < 20; ++tick) {
      world_.Step(command, 0.0);
      observer_.OnTick(false);
    }
  };
  EXPECT_EQ(Report().steer_turned_rad, 0.0);
  steer_to(0.1, 0.2);
  EXPECT_NEAR(Report().steer_turned_rad, 0.15, 1e-12);
  EXPECT_NEAR(Report().steer_turned_max_rad, 0.2, 1e-12);
  steer_to(0.0, -0.1);
  EXPECT_NEAR(Report().steer_turned_rad, 0.35, 1e-12);
  EXPECT_NEAR(Report().steer_turned_max_rad, 0.5, 1e-12);
  // Operators put the rover down with straight wheels.
  world_.Place({1.0, 0.0, 0.0});
  observer_.OnPlaced();
  observer_.OnTick(false);
  EXPECT_NEAR(Report().steer_turned_rad, 0.35, 1e-12);
}

}  // namespace
}  // namespace rockyard::trial
