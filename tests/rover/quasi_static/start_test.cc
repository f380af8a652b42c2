// How the quasi-static rover starts, stops and changes its motion where its wheels slide: against
// closed forms and the multibody.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "rover/quasi_static/progress.h"
#include "rover/quasi_static/quasi_static_rover.h"
#include "rover/rover_drive.h"

namespace rockyard::rover {
namespace {

constexpr double kUphill = 0.0;
constexpr double kDownhill = std::numbers::pi;

RoverParams With(Fidelity fidelity, double ramp_s) {
  RoverParams params = WithFidelity(fidelity);
  params.drive.ramp_s = ramp_s;
  return params;
}

// The rover stands on a rock as flat as a table, 10 cm above the ground.
terrain::Terrain RockTable() {
  return FlatTerrain({MakeRock(0.0, 0.0, 0.1 - 1000.0, 1000.0, 1000.0, 1000.0)});
}

// By Coulomb's law motors that jump drag the rover at mu g until it has their speed, so it loses
// v^2 / (2 mu g), and slides on by as much when they stop. Within 0.25 mm, as it nods.
TEST(QuasiStaticStart, SlidesOnRockByCoulombsLaw) {
  const terrain::Terrain terrain = RockTable();
  for (const Fidelity fidelity : {Fidelity::kMultibody, Fidelity::kQuasiStatic}) {
    for (const double friction : {0.1, 0.2, 0.4}) {
      RoverParams params = With(fidelity, 0.0);
      params.contact.wheel_rock_friction = friction;
      const auto rover = PlacedRover(params, terrain);
      const auto x_m = [&] { return rover->state().X_WR.translation().x(); };
      const double from_m = x_m();
      RunFor(*rover, Drive(params, 0.15, 0.0), 0.6);
      const double rolled_m = params.geometry.wheel_radius_m * rover->state().wheel_angle_rad[0];
      const double brakes_at_m = x_m();
      RunFor(*rover, kBraked, 0.5);
      const double slide_m = 0.15 * 0.15 / (2.0 * friction * 9.81);
      EXPECT_NEAR(rolled_m - (brakes_at_m - from_m), slide_m, 2.5e-4) << friction;
      EXPECT_NEAR(x_m() - brakes_at_m, slide_m, 2.5e-4) << friction;
    }
  }
}

// Left wheels on a ridge of rock, right ones on sand: each side pulls by its own law. Half a second
// of driving, and what comes after the brakes.
TEST(QuasiStaticStart, RockAndSoilPullTogether) {
  const terrain::Terrain terrain = FlatTerrain({MakeRock(0.0, 0.21, -4.98, 50.0, 0.13, 5.0)});
  for (const double friction : {0.1, 0.3, 0.8}) {
    double driven_m[2] = {};
    double slid_m[2] = {};
    for (const Fidelity fidelity : {Fidelity::kMultibody, Fidelity::kQuasiStatic}) {
      RoverParams params = With(fidelity, 0.0);
      params.contact.wheel_rock_friction = friction;
      const auto rover = PlacedRover(params, terrain);
      const double from_m = rover->state().X_WR.translation().x();
      RunFor(*rover, Drive(params, 0.15, 0.0), 0.5);
      const double brakes_at_m = rover->state().X_WR.translation().x();
      RunFor(*rover, kBraked, 0.5);
      const auto level = static_cast<std::size_t>(fidelity);
      driven_m[level] = brakes_at_m - from_m;
      slid_m[level] = rover->state().X_WR.translation().x() - brakes_at_m;
    }
    EXPECT_NEAR(driven_m[1], driven_m[0], 1.2e-3) << friction;
    EXPECT_NEAR(slid_m[1], slid_m[0], 6e-4) << friction;
  }
}

// A rover that turns in place has inertia, too: of each start and stop on sand it loses what the
// multibody loses, and on hard ground, where wheels hold, both turn as far as their rims.
TEST(QuasiStaticStart, TurnsInPlaceWithTheInertiaOfTheMultibody) {
  for (const auto preset :
       {terrain::SoilPreset::kLandscapingSand, terrain::SoilPreset::kHardGround}) {
    const terrain::Terrain terrain = SlopeTerrain(0.0, 0.0, terrain::MakeSoil(preset));
    for (const auto& [ramp_s, margin] : {std::pair{0.0, 0.017}, {0.1, 0.008}}) {
      double turned_rad[2] = {};
      for (const Fidelity fidelity : {Fidelity::kMultibody, Fidelity::kQuasiStatic}) {
        const RoverParams params = With(fidelity, ramp_s);
        const auto rover = PlacedRover(params, terrain);
        const messages::WheelCommand turn = Drive(params, 0.0, 0.4);
        RunFor(*rover, SteerOnly(turn), 1.0);
        for (int i = 0; i < 4; ++i) {
          RunFor(*rover, turn, 0.2);
          RunFor(*rover, SteerOnly(turn), ramp_s + 0.1);
        }
        turned_rad[static_cast<std::size_t>(fidelity)] = math::Heading(rover->state().X_WR);
      }
      EXPECT_NEAR(turned_rad[1], turned_rad[0], margin * turned_rad[0]) << "ramp " << ramp_s;
    }
  }
}

// Straight wheels that turn against each other drag the corner wheels sideways, one half to the
// left and the other to the right.
TEST(QuasiStaticStart, SkidsAroundWithTheInertiaOfTheMultibody) {
  const terrain::Terrain terrain = FlatTerrain();
  for (const double ramp_s : {0.0, 0.1}) {
    double turned_rad[2] = {};
    for (const Fidelity fidelity : {Fidelity::kMultibody, Fidelity::kQuasiStatic}) {
      const RoverParams params = With(fidelity, ramp_s);
      const auto rover = PlacedRover(params, terrain);
      messages::WheelCommand skid;
      for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
        skid.rate_rad_s[i] = (i < 3 ? -0.12 : 0.12) / params.geometry.wheel_radius_m;
      }
      for (int i = 0; i < 4; ++i) {
        RunFor(*rover, skid, 0.4);
        RunFor(*rover, kBraked, ramp_s + 0.1);
      }
      turned_rad[static_cast<std::size_t>(fidelity)] = math::Heading(rover->state().X_WR);
    }
    EXPECT_NEAR(turned_rad[1], turned_rad[0], 0.012 * turned_rad[0]) << "ramp " << ramp_s;
  }
}

// The way in the first `time_s` after motors have jumped or ramped.
double WayOfStart(Fidelity fidelity, double ramp_s, const terrain::Terrain& terrain,
                  double time_s) {
  const RoverParams params = With(fidelity, ramp_s);
  const auto rover = PlacedRover(params, terrain);
  const double from_m = rover->state().X_WR.translation().x();
  RunFor(*rover, Drive(params, 0.15, 0.0), time_s);
  return rover->state().X_WR.translation().x() - from_m;
}

// Downhill a rover runs ahead of its rims: that is a motion that starts, too, and no fall.
TEST(QuasiStaticStart, StartsDownhillLikeTheMultibody) {
  for (const double slope_deg : {10.0, 15.0, 20.0}) {
    const terrain::Terrain terrain = SlopeTerrain(math::DegToRad(slope_deg), kDownhill);
    for (const double time_s : {0.1, 0.3}) {
      EXPECT_NEAR(WayOfStart(Fidelity::kQuasiStatic, 0.0, terrain, time_s),
                  WayOfStart(Fidelity::kMultibody, 0.0, terrain, time_s), 1e-3)
          << slope_deg << " deg, " << time_s << " s";
    }
  }
}

// On a slope that soft soil does not carry it up, the rover starts to slide back while its wheels
// turn forward: against them, not with them.
TEST(QuasiStaticStart, StartsToSlideBackLikeTheMultibody) {
  terrain::SoilParams soft{.law = terrain::WheelLaw::kBekker, .shear_modulus_m = 0.03};
  const terrain::Terrain terrain = SlopeTerrain(math::DegToRad(18.0), kUphill, soft);
  for (const double ramp_s : {0.0, 0.1}) {
    const double multibody_m = WayOfStart(Fidelity::kMultibody, ramp_s, terrain, 0.2);
    ASSERT_LT(multibody_m, -0.01);
    EXPECT_NEAR(WayOfStart(Fidelity::kQuasiStatic, ramp_s, terrain, 0.2), multibody_m, 1.5e-3)
        << "ramp " << ramp_s;
  }
}

// A rover that drives straight on and is then told a wide arc follows it, though its wheels differ
// by a few thousandths only.
TEST(QuasiStaticStart, FollowsWideArcsFromStraightDrives) {
  const terrain::Terrain terrain = FlatTerrain();
  for (const double radius_m : {300.0, 50.0, 20.0}) {
    double turned_rad[2] = {};
    for (const Fidelity fidelity : {Fidelity::kMultibody, Fidelity::kQuasiStatic}) {
      const RoverParams params = With(fidelity, 0.1);
      const auto rover = PlacedRover(params, terrain);
      RunFor(*rover, Drive(params, 0.14, 0.0), 0.5);
      RunFor(*rover, Drive(params, 0.14, 0.14 / radius_m), 5.0);
      turned_rad[static_cast<std::size_t>(fidelity)] = math::Heading(rover->state().X_WR);
    }
    EXPECT_NEAR(turned_rad[1], turned_rad[0], 0.02 * turned_rad[0]) << radius_m;
  }
}

// The quasi-static rover with its brakes on: what holds it, what does not, and how it drives on.

RoverParams QuasiStatic(double ramp_s) {
  RoverParams params = WithFidelity(Fidelity::kQuasiStatic);
  params.drive.ramp_s = ramp_s;
  return params;
}

// Slippery ground: brakes hold on slopes up to the angle of friction, and not half a degree beyond
// it.
TEST(QuasiStaticStanding, SlidesOffSlipperyGroundBeyondItsAngleOfFriction) {
  for (const double friction : {0.1, 0.2}) {
    for (const double excess_deg : {-1.0, -0.2, 0.5, 1.0}) {
      const double slope = std::atan(friction) + math::DegToRad(excess_deg);
      const terrain::Terrain terrain =
          SlopeTerrain(slope, 0.5 * std::numbers::pi, RigidGround(friction));
      const auto rover = PlacedRover(QuasiStatic(0.1), terrain);
      const math::Vector3 from = rover->state().X_WR.translation();
      RunFor(*rover, kBraked, 1.0);
      const math::Vector3 moved = rover->state().X_WR.translation() - from;
      if (excess_deg < 0.0) {
        EXPECT_LT(moved.norm(), 1e-4) << friction << ", " << excess_deg;
      } else {
        EXPECT_LT(moved.y(), -0.05) << friction;
      }
    }
  }
}

// Over an edge of 20 cm the rover falls wheel by wheel. Whenever it brakes, it hangs nowhere: what
// it stands on bears its weight, but for the slant of the edge.
TEST(QuasiStaticStanding, HangsNowhereWhenItBrakesOverAnEdge) {
  const RoverParams params = QuasiStatic(0.1);
  const terrain::Terrain terrain = StepTerrain(0.2);
  const double weight_N = Weights(params).total_N;
  for (int steps = 85; steps < 105; ++steps) {
    const auto rover = PlacedRover(params, terrain, {1.2, 0.0, 0.0});
    for (int i = 0; i < steps; ++i) rover->Step(Drive(params, 0.15, 0.0));
    RunFor(*rover, kBraked, 1.0);
    double borne_N = 0.0;
    for (const double load_N : rover->state().wheel_load_N) borne_N += load_N;
    for (const truth::BodyContact& contact : rover->state().contacts) {
      borne_N += contact.normal_force_N;
    }
    EXPECT_GT(borne_N, 0.85 * weight_N) << steps;
  }
}

// Where brakes hold by a narrow margin, each stop has a balance of its own. When the wheels turn
// again, the velocity that the rover reports is still what its position changes by.
TEST(QuasiStaticStanding, ReportsTheVelocityOfItsMotionAfterAStopOnASlope) {
  for (const double friction : {0.1, 0.2, 0.5}) {
    const RoverParams params = QuasiStatic(0.1);
    const terrain::Terrain terrain =
        SlopeTerrain(0.96 * std::atan(friction), 0.0, RigidGround(friction));
    const auto rover = PlacedRover(params, terrain);
    const messages::WheelCommand drive = Drive(params, 0.07, 0.0);
    for (int stop = 0; stop < 5; ++stop) {
      RunFor(*rover, drive, 0.2);
      const math::Vector3 from = rover->state().X_WR.translation();
      rover->Step(drive);
      const math::Vector3 mean_m_s = (rover->state().X_WR.translation() - from) / rover->step_s();
      ASSERT_GT(mean_m_s.norm(), 2e-3);
      EXPECT_NEAR((rover->state().v_WR_m_s - mean_m_s).norm(), 0.0, 0.3 * mean_m_s.norm())
          << friction << ", stop " << stop;
      RunFor(*rover, kBraked, 0.3);
    }
  }
}

// Where friction holds it with ease a stop asks for no balance, nor do ramps: there is one for each
// stretch of rim travel, on straight drives and arcs, and two of them at the first start.
TEST(QuasiStaticStanding, StopsOnGentleSlopesTakeNoBalanceOfTheirOwn) {
  for (const double slope_deg : {10.0, 15.0}) {
    const terrain::Terrain terrain = SlopeTerrain(math::DegToRad(slope_deg), 1.0);
    for (const double ramp_s : {0.05, 0.1, 0.23}) {
      for (const double turn_rad_s : {0.0, 0.1}) {
        const RoverParams params = QuasiStatic(ramp_s);
        QuasiStaticRover rover(params, terrain);
        rover.Place({});
        const messages::WheelCommand drive = Drive(params, 0.1, turn_rad_s);
        RunFor(rover, SteerOnly(drive), 1.0);
        const std::int64_t before = rover.work().balances;
        for (int stop = 0; stop < 10; ++stop) {
          RunFor(rover, drive, 0.4);
          RunFor(rover, SteerOnly(drive), ramp_s + 0.05);
        }
        double farthest_rad = 0.0;
        for (const double angle_rad : rover.state().wheel_angle_rad) {
          farthest_rad = std::max(farthest_rad, angle_rad);
        }
        const double stretches =
            farthest_rad * params.geometry.wheel_radius_m / params.quasi_static.settle_distance_m;
        EXPECT_LE(static_cast<double>(rover.work().balances - before), stretches + 2.0)
            << slope_deg << " deg, ramp " << ramp_s << ", turn " << turn_rad_s;
      }
    }
  }
}

// Starts and stops of the quasi-static rover against closed forms.

// 20 kg at 15 cm/s on wheels that pull 100 N by Coulomb friction.
SteadyDrive OnRock() {
  SteadyDrive drive;
  drive.rock = {.traction_N = 100.0, .rim_m_s = 0.15, .along_m_s = 0.15};
  drive.inertia_J = 20.0 * 0.15 * 0.15;
  return drive;
}

double WayOf(Progress& progress, double rim, double time_s) {
  double way_s = 0.0;
  for (int i = 0; i < static_cast<int>(std::lround(time_s / 0.05)); ++i) {
    way_s += progress.Advance(rim, rim, 0.05);
  }
  return way_s;
}

// Rims that jump drag a rover that slides by F = T: it loses v / (2 a) of a second, a = T / m, and
// makes as much when they stop at once.
TEST(Progress, JumpsCostAndGainTheTimeOfSliding) {
  Progress progress;
  progress.Begin(OnRock(), 1.0);
  const double sliding_s = 0.15 / (2.0 * 100.0 / 20.0);
  EXPECT_NEAR(WayOf(progress, 1.0, 1.0), 1.0 - sliding_s, 1e-3);
  EXPECT_NEAR(progress.speed(), 1.0, 1e-3);
  EXPECT_NEAR(WayOf(progress, 0.0, 1.0), sliding_s, 1e-3);
  EXPECT_EQ(progress.speed(), 0.0);
}

TEST(Progress, SteadyMotionMakesAllOfItsWay) {
  Progress progress;
  progress.Begin(OnRock(), 1.0);
  WayOf(progress, 1.0, 1.0);
  EXPECT_EQ(progress.Advance(1.0, 1.0, 0.05), 0.05);
}

TEST(Progress, AnotherMotionKeepsItsShareOfTheSpeed) {
  Progress progress;
  progress.Begin(OnRock(), 1.0);
  WayOf(progress, 1.0, 1.0);
  progress.Begin(OnRock(), 0.25);
  EXPECT_NEAR(progress.speed(), 0.25, 1e-3);
  progress.Begin(OnRock(), 0.0);
  EXPECT_EQ(progress.speed(), 0.0);
}

// Wheels without any traction neither start a rover nor keep it rolling: it is where its rims are.
TEST(Progress, WithoutTractionTheRimsDecide) {
  Progress progress;
  SteadyDrive drive = OnRock();
  drive.rock.traction_N = 0.0;
  progress.Begin(drive, 1.0);
  EXPECT_EQ(progress.Advance(0.0, 1.0, 0.1), 0.05);
  progress.Advance(0.0, 0.0, 0.1);
  EXPECT_EQ(progress.speed(), 0.0);
}

// Soil in its linear range, F = T u / 2 with u = (l / K) i: the rover follows jumped rims as
// 1 - e^(-t / s), s = 2 m v / (T l / K), and loses s in all, whatever the step.
TEST(Progress, LinearSlipLosesItsTimeConstant) {
  Progress progress;
  SteadyDrive drive;
  drive.soil = {.traction_N = 100.0, .rim_m_s = 0.15, .along_m_s = 0.15, .shear_ratio = 0.02};
  drive.inertia_J = 20.0 * 0.15 * 0.15;
  progress.Begin(drive, 1.0);
  const double constant_s = 2.0 * 20.0 * 0.15 / (100.0 * 0.02);
  EXPECT_NEAR(WayOf(progress, 1.0, 12.0 * constant_s), 11.0 * constant_s, 0.02 * constant_s);
}

TEST(ShareTable, IsTheCurveOfShear) {
  const ShareTable table;
  for (double u = 0.0; u < 40.0; u += 0.0137) {
    const ShearShare expected = ShareOfRatio(u);
    EXPECT_NEAR(table.At(u).value, expected.value, 1e-7) << u;
    EXPECT_NEAR(table.At(u).slope, expected.slope, 2e-5) << u;
  }
}

}  // namespace
}  // namespace rockyard::rover
