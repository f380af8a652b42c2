// What the closed loop makes of what the rover feels: counts, and what a move by hand forgets.

#include "trial/drive/vehicle_guard.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "math/angles.h"
#include "sensing/vehicle_sensors.h"
#include "terrain/ground.h"
#include "trial/aids/slip_alarms.h"
#include "trial/counters/hazard_watch.h"
#include "trial/drive/tick_guard.h"

namespace rockyard::trial {
namespace {

using messages::VehicleHazardKind;
using navigation::SlipResponse;

constexpr double kTick_s = 0.05;

DriveParams Feeling(std::int64_t latency_ticks) {
  DriveParams drive;
  auto& sensors = drive.sensors.vehicle;
  sensors.contact.enabled = sensors.accelerometers.enabled = true;
  sensors.contact.latency_ticks = sensors.accelerometers.latency_ticks = latency_ticks;
  sensors.accelerometers.noise_m_s2 = 0.0;
  drive.perception.vehicle_hazard.contact_ticks = 1;
  drive.perception.vehicle_hazard.tilt_ticks = 3;
  return drive;
}

truth::RoverState Leaning(double roll_rad) {
  truth::RoverState state;
  state.X_WR.linear() = Eigen::AngleAxisd(roll_rad, math::Vector3::UnitX()).matrix();
  return state;
}

truth::RoverState Touching(const rover::RoverGeometryParams& size, double end) {
  truth::RoverState state;
  state.contacts = {{.part = truth::BodyPart::kPanelEdge,
                     .rock = 0,
                     .normal_force_N = 20.0,
                     .p_RoC_R = {end * 0.5 * size.length_m, 0.0, 0.28}}};
  return state;
}

// Sensors and what the rover makes of them.
struct Feeler {
  explicit Feeler(const DriveParams& drive)
      : sensors(drive.sensors.vehicle, drive.rover, {1, 0}), guard(drive) {}

  // One control tick at a state. True where something has appeared.
  bool Feel(const truth::RoverState& state) {
    sensors.Observe(state);
    const messages::VehicleState felt = sensors.Measure(state, {}, kTick_s);
    return !guard.Feel(felt, {}, {.duration_s = kTick_s}).empty();
  }
  void Place(const truth::RoverState& state) {
    sensors.Restart(state);
    guard.OnPlaced();
  }

  sensing::VehicleSensors sensors;
  VehicleGuard guard;
};

TEST(VehicleGuardTest, TouchesFromBeforeAHandMoveAreForgotten) {
  for (const std::int64_t latency : {0, 1, 3}) {
    const DriveParams drive = Feeling(latency);
    Feeler feeler(drive);
    const VehicleGuard& guard = feeler.guard;
    const truth::RoverState touching = Touching(drive.rover.geometry, +1.0);
    EXPECT_TRUE(feeler.Feel(touching));
    for (int tick = 0; tick < 4; ++tick) EXPECT_FALSE(feeler.Feel(touching));
    ASSERT_NE(guard.hazard(), nullptr);
    feeler.Place({});
    EXPECT_EQ(guard.hazard(), nullptr);
    for (int tick = 0; tick < 6; ++tick) {
      EXPECT_FALSE(feeler.Feel({})) << latency;
      EXPECT_EQ(guard.hazard(), nullptr) << latency;
    }
    EXPECT_EQ(guard.count(VehicleHazardKind::kContact), 1);
  }
}

// Every kind is counted when it appears, also one that appears beside another.
TEST(VehicleGuardTest, CountsEachKindWhenItAppears) {
  const DriveParams drive = Feeling(0);
  for (const double end : {+1.0, -1.0}) {  // touches ahead, behind
    Feeler feeler(drive);
    const VehicleGuard& guard = feeler.guard;
    truth::RoverState state = Touching(drive.rover.geometry, end);
    state.X_WR.linear() = Leaning(math::DegToRad(35.0)).X_WR.linear();
    for (int tick = 0; tick < 5; ++tick) feeler.Feel(state);
    EXPECT_EQ(guard.count(VehicleHazardKind::kContact), 1);
    EXPECT_EQ(guard.count(VehicleHazardKind::kTilt), 1);
    EXPECT_EQ(guard.touches_behind(), end < 0.0);
    ASSERT_NE(guard.hazard(), nullptr);
    EXPECT_EQ(guard.hazard()->kind,
              end < 0.0 ? VehicleHazardKind::kTilt : VehicleHazardKind::kContact);
    // Nothing appears where the touch ends and the tilt lasts.
    EXPECT_FALSE(feeler.Feel(Leaning(math::DegToRad(35.0))));
    EXPECT_EQ(guard.count(VehicleHazardKind::kTilt), 1);
  }
}

TEST(VehicleGuardTest, TicksFromBeforeAHandMoveDoNotCount) {
  Feeler feeler(Feeling(0));
  const truth::RoverState steep = Leaning(math::DegToRad(35.0));
  EXPECT_FALSE(feeler.Feel(steep));
  EXPECT_FALSE(feeler.Feel(steep));
  feeler.Place(steep);
  EXPECT_FALSE(feeler.Feel(steep));
  EXPECT_FALSE(feeler.Feel(steep));
  EXPECT_TRUE(feeler.Feel(steep));  // the third in a row, as tilt_ticks asks
}

terrain::Rock MakeRock(double x_m, double y_m, double a_m, double b_m, double yaw_rad,
                       double height_m) {
  return {.center_W = {x_m, y_m, 0.0},
          .semi_axes_m = {a_m, b_m, height_m},
          .yaw_rad = yaw_rad,
          .height_m = height_m};
}

math::Transform At(double x_m, double y_m, double heading_rad) {
  math::Transform X_WR = math::Transform::Identity();
  X_WR.translation() = math::Vector3(x_m, y_m, 0.0);
  X_WR.linear() = Eigen::AngleAxisd(heading_rad, math::Vector3::UnitZ()).matrix();
  return X_WR;
}

// Against points of the outline and the interior, tested one by one.
bool ReachesByPoints(const terrain::Rock& rock, const Zone& zone, const math::Transform& X_WR) {
  const math::Transform X_RW = X_WR.inverse();
  for (int ring = 0; ring <= 60; ++ring) {
    for (int i = 0; i < 720; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 720;
      const double u = rock.semi_axes_m.x() * ring / 60.0 * std::cos(angle);
      const double v = rock.semi_axes_m.y() * ring / 60.0 * std::sin(angle);
      const double c = std::cos(rock.yaw_rad);
      const double s = std::sin(rock.yaw_rad);
      const math::Vector3 p_R =
          X_RW * (rock.center_W + math::Vector3(c * u - s * v, s * u + c * v, 0.0));
      if (p_R.x() >= zone.x_low_m && p_R.x() <= zone.x_high_m && p_R.y() >= zone.y_low_m &&
          p_R.y() <= zone.y_high_m) {
        return true;
      }
    }
  }
  return false;
}

TEST(ReachesTest, AgreesWithPointsOfTheOutline) {
  const Zone zone{0.3, 0.6, -0.2, 0.35};
  core::RandomStream random({5, 0}, core::Purpose::kTest);
  int reached = 0;
  for (int i = 0; i < 300; ++i) {
    const double b_m = 0.05 + 0.1 * random.Uniform();
    const double a_m = b_m + 0.1 * random.Uniform();
    const terrain::Rock rock = MakeRock(1.2 * random.Uniform() - 0.1, 1.2 * random.Uniform() - 0.6,
                                        a_m, b_m, 3.0 * random.Uniform(), 0.2);
    const math::Transform X_WR = At(0.1, -0.1, 2.0 * random.Uniform() - 1.0);
    const bool expected = ReachesByPoints(rock, zone, X_WR);
    // A hair's breadth between the two is allowed.
    terrain::Rock larger = rock;
    larger.semi_axes_m *= 1.02;
    if (expected) {
      EXPECT_TRUE(Reaches(rock, zone, X_WR)) << i;
    } else if (!ReachesByPoints(larger, zone, X_WR)) {
      EXPECT_FALSE(Reaches(rock, zone, X_WR)) << i;
    }
    reached += expected;
  }
  EXPECT_GT(reached, 50);
  EXPECT_LT(reached, 250);
}

class HazardWatchTest : public testing::Test {
 protected:
  void Rocks(std::vector<terrain::Rock> rocks) {
    terrain_.emplace(terrain::Ground(), std::move(rocks), std::vector<terrain::Wall>{});
    watch_.emplace(ArrayZone({}), rover::RoverGeometryParams{}, 0.13, *terrain_);
  }
  void Drive(double from_m, double to_m, double y_m = 0.0) {
    for (double x_m = from_m; x_m < to_m; x_m += 0.01) watch_->Observe(At(x_m, y_m, 0.0));
  }

  std::optional<terrain::Terrain> terrain_;
  std::optional<HazardWatch> watch_;
};

TEST_F(HazardWatchTest, DrivingOntoWhatWasNotBelievedIsAMiss) {
  Rocks({MakeRock(1.5, 0.0, 0.12, 0.12, 0.0, 0.2)});
  Drive(0.0, 0.7);  // the array ends at 0.625 m ahead
  EXPECT_EQ(watch_->met(), 0);
  Drive(0.7, 0.9);
  EXPECT_EQ(watch_->met(), 1);
  EXPECT_EQ(watch_->missed(), 0);
  Drive(0.9, 2.5);  // the front is 0.325 m ahead
  EXPECT_EQ(watch_->met(), 1);
  EXPECT_EQ(watch_->missed(), 1);
}

TEST_F(HazardWatchTest, ABelievedHazardIsNoMiss) {
  Rocks({MakeRock(1.5, 0.0, 0.12, 0.12, 0.0, 0.2)});
  Drive(0.0, 0.9);
  watch_->OnBelieved(At(0.9, 0.0, 0.0));
  Drive(0.9, 2.5);
  EXPECT_EQ(watch_->met(), 1);
  EXPECT_EQ(watch_->missed(), 0);
}

TEST_F(HazardWatchTest, BeliefElsewhereDoesNotHelp) {
  Rocks({MakeRock(1.5, 0.0, 0.12, 0.12, 0.0, 0.2)});
  watch_->OnBelieved(At(0.0, 0.0, 0.0));
  Drive(0.0, 2.5);
  EXPECT_EQ(watch_->missed(), 1);
}

TEST_F(HazardWatchTest, LowRocksAndThoseBesideTheWayDoNotCount) {
  Rocks({MakeRock(1.5, 0.0, 0.12, 0.12, 0.0, 0.129), MakeRock(2.5, 0.6, 0.12, 0.12, 0.0, 0.3)});
  Drive(0.0, 4.0);
  EXPECT_EQ(watch_->met(), 0);
  EXPECT_EQ(watch_->missed(), 0);
}

TEST_F(HazardWatchTest, MetBesideTheWheelsIsNoMiss) {
  Rocks({MakeRock(1.5, 0.42, 0.1, 0.1, 0.0, 0.3)});  // from 0.32; wheels end at 0.24
  Drive(0.0, 4.0);
  EXPECT_EQ(watch_->met(), 1);
  EXPECT_EQ(watch_->missed(), 0);
}

// Alarms of slip: what ends a drive, and what a navigator is told.

TEST(SlipAlarmsTest, NothingIsToldWithoutOne) {
  SlipAlarms alarms({SlipResponse::kReplan, 0});
  EXPECT_FALSE(alarms.EndsDrive());
  EXPECT_FALSE(alarms.Take());
}

TEST(SlipAlarmsTest, TheFirstStopsTheDriveByDefault) {
  SlipAlarms alarms({});
  EXPECT_FALSE(alarms.EndsDrive());
  alarms.Raise();
  EXPECT_TRUE(alarms.EndsDrive());
}

TEST(SlipAlarmsTest, EachIsToldOnce) {
  SlipAlarms alarms({SlipResponse::kReplan, 5});
  alarms.Raise();
  const std::optional<ToldSlip> told = alarms.Take();
  ASSERT_TRUE(told && told->hazard);
  EXPECT_EQ(told->hazard->kind, messages::VehicleHazardKind::kSlip);
  EXPECT_EQ(told->hazard->side, messages::HazardSide::kAhead);
  EXPECT_FALSE(told->as_stuck);
  EXPECT_FALSE(alarms.Take());
}

TEST(SlipAlarmsTest, IsToldAsBeingStuck) {
  SlipAlarms alarms({SlipResponse::kAsStuck, 5});
  alarms.Raise();
  const std::optional<ToldSlip> told = alarms.Take();
  ASSERT_TRUE(told);
  EXPECT_TRUE(told->as_stuck);
  EXPECT_FALSE(told->hazard);
}

TEST(SlipAlarmsTest, OneMoreThanTheMostEndsTheDrive) {
  for (const SlipResponse reaction : {SlipResponse::kAsStuck, SlipResponse::kReplan}) {
    SlipAlarms alarms({reaction, 2});
    for (int i = 0; i < 2; ++i) {
      alarms.Raise();
      EXPECT_FALSE(alarms.EndsDrive());
      EXPECT_TRUE(alarms.Take());
    }
    alarms.Raise();
    EXPECT_TRUE(alarms.EndsDrive());
  }
}

// Operators who moved the rover saw to it; it was an alarm all the same.
TEST(SlipAlarmsTest, AMoveByHandDropsWhatIsRaisedAndNotTheCount) {
  SlipAlarms alarms({SlipResponse::kReplan, 1});
  alarms.Raise();
  alarms.OnPlaced();
  EXPECT_FALSE(alarms.Take());
  alarms.Raise();
  EXPECT_TRUE(alarms.EndsDrive());
  alarms.OnPlaced();
  EXPECT_FALSE(alarms.EndsDrive());
}

// How many decisions pass before the guard ends the drive; each takes `step_s`.
std::int64_t Decisions(TickGuard guard, double step_s, std::int64_t most) {
  try {
    for (std::int64_t i = 0; i < most; ++i) guard.Observe(static_cast<double>(i) * step_s);
  } catch (const std::runtime_error&) {
    return -1;
  }
  return most;
}

// A move and a look at every tick, to the time limit and one look beyond it.
TEST(TickGuard, LetsEveryRealDriveEnd) {
  const std::int64_t ticks = 14400 * 20;
  EXPECT_EQ(Decisions({14400.0, 0.05}, 0.025, 2 * ticks + 2), 2 * ticks + 2);
  EXPECT_EQ(Decisions({1.0, 0.05}, 0.001, 1000), 1000);
}

TEST(TickGuard, EndsADriveThatIsNeverJudged) {
  EXPECT_EQ(Decisions({100.0, 0.05}, 0.05, 1'000'000), -1);
}

TEST(TickGuard, EndsDecisionsWithoutTime) {
  EXPECT_EQ(Decisions({14400.0, 0.05}, 0.0, TickGuard::kMaxWithoutTime), 10'000);
  EXPECT_EQ(Decisions({14400.0, 0.05}, 0.0, TickGuard::kMaxWithoutTime + 2), -1);
}

// Without a time limit a drive has as many decisions as two hours of motion and somewhat more.
TEST(TickGuard, EndsADriveWithoutTimeLimitThatGoesOnForEver) {
  EXPECT_EQ(Decisions({0.0, 0.05}, 0.05, 2 * 3600 * 20), 2 * 3600 * 20);
  EXPECT_EQ(Decisions({0.0, 0.05}, 1e5, TickGuard::kUnlimited), TickGuard::kUnlimited);
  EXPECT_EQ(Decisions({0.0, 0.05}, 1e5, TickGuard::kUnlimited + 1), -1);
}

}  // namespace
}  // namespace rockyard::trial
