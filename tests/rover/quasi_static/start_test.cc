// How the quasi-static rover starts, stops and changes its motion where its wheels slide: against
// closed forms and the multibody.
#include <gtest/gtest.h>

#include <numbers>

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
  terrain::SoilParams soft{.shear_modulus_m = 0.03};
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

}  // namespace
}  // namespace rockyard::rover
