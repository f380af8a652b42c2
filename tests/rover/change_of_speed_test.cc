// Reversals, steep ramps, slow rovers and loose rocks: what the length of a step makes of a change
// of speed.
#include <gtest/gtest.h>

#include "rover/multibody/loose_rocks.h"
#include "stop_and_go.h"
#include "terrain/rock.h"

namespace rockyard::rover {
namespace {

RoverParams WithRamp(double ramp_s, double rate_Hz = 60.0) {
  return RoverParams{.drive = {.ramp_s = ramp_s}, .physics = {.step_s = 1.0 / rate_Hz}};
}

terrain::Terrain Level(terrain::SoilPreset preset) {
  return SlopeTerrain(0.0, 0.0, terrain::MakeSoil(preset));
}

// Where the rover is after it was told to and fro twice, with a stop before each change of mind.
double WayToAndFro(const RoverParams& params, const terrain::Terrain& terrain, double stop_s) {
  const auto rover = PlacedRover(params, terrain);
  const double from_m = rover->state().X_WR.translation().x();
  for (int i = 0; i < 2; ++i) {
    RunFor(*rover, Drive(params, 0.15, 0.0), 0.5);
    RunFor(*rover, kBraked, stop_s);
    RunFor(*rover, Drive(params, -0.15, 0.0), 0.25);
    RunFor(*rover, kBraked, stop_s);
  }
  RunFor(*rover, kBraked, 0.2);
  return rover->state().X_WR.translation().x() - from_m;
}

// From forward to backward wheels pass through rest, where slip has no meaning. Of 22 cm to and fro
// a step sixteen times finer leaves the rover within half a millimetre of the same place.
TEST(ChangeOfSpeed, ReversalsAt60HzAreThoseAt960Hz) {
  struct Case {
    terrain::SoilPreset soil;
    double ramp_s;
    double stop_s;
  };
  for (const Case& c : {Case{terrain::SoilPreset::kLandscapingSand, 0.0, 0.0},
                        {terrain::SoilPreset::kLandscapingSand, 0.1, 0.0},
                        {terrain::SoilPreset::kMarsDrift, 0.0, 0.05}}) {
    const terrain::Terrain terrain = Level(c.soil);
    EXPECT_NEAR(WayToAndFro(WithRamp(c.ramp_s), terrain, c.stop_s),
                WayToAndFro(WithRamp(c.ramp_s, 960.0), terrain, c.stop_s), 5e-4)
        << "ramp " << c.ramp_s << ", stop " << c.stop_s;
  }
}

// Both levels, and a stop between the two ways costs both the same. Without a ramp the rover nods,
// which only the multibody knows.
TEST(ChangeOfSpeed, BothLevelsReverseAlike) {
  const terrain::Terrain terrain = FlatTerrain();
  for (const auto& [ramp_s, margin_m] :
       {std::pair{0.0, 5e-3}, {0.05, 1e-3}, {0.075, 1e-3}, {0.1, 1e-3}}) {
    for (const double stop_s : {0.0, 0.05}) {
      RoverParams params = WithRamp(ramp_s);
      const double multibody = WayToAndFro(params, terrain, stop_s);
      params.fidelity = Fidelity::kQuasiStatic;
      EXPECT_NEAR(WayToAndFro(params, terrain, stop_s), multibody, margin_m)
          << "ramp " << ramp_s << ", stop " << stop_s;
    }
  }
}

// Ramps on which wheels slide, though their motors do not jump: on drift the rover follows slowly,
// and what it loses does not hang on the step.
TEST(ChangeOfSpeed, SteepRampsLoseAsMuchAt60HzAsAt480Hz) {
  const terrain::Terrain terrain = Level(terrain::SoilPreset::kMarsDrift);
  for (const double ramp_s : {0.02, 0.035}) {
    const double fine = DriveLegs(WithRamp(ramp_s, 480.0), terrain, 1).along;
    EXPECT_NEAR(DriveLegs(WithRamp(ramp_s), terrain, 1).along, fine, 0.0015 * fine) << ramp_s;
  }
}

// A slow rover that is simulated faster than real starts and stops as it does in real time: each
// stop costs a share of its way, as the ramp does.
TEST(ChangeOfSpeed, TimeScaleDoesNotChangeWhatAStopCosts) {
  const terrain::Terrain terrain = FlatTerrain();
  const auto way_over_rims = [&](double time_scale) {
    RoverParams params{.drive = {.speed_m_s = 0.0067}, .physics = {.time_scale = time_scale}};
    const auto rover = PlacedRover(params, terrain);
    const double from_m = rover->state().X_WR.translation().x();
    for (int i = 0; i < 3; ++i) {
      RunFor(*rover, Drive(params, params.drive.speed_m_s, 0.0), 8.0);
      RunFor(*rover, kBraked, rover->ramp_s() + 1.0);
    }
    const double rolled_m = params.geometry.wheel_radius_m * rover->state().wheel_angle_rad[0];
    return (rover->state().X_WR.translation().x() - from_m) / rolled_m;
  };
  const double real = way_over_rims(1.0);
  for (const double time_scale : {5.0, 10.0}) {
    EXPECT_NEAR(way_over_rims(time_scale), real, 0.005) << time_scale;
  }
}

// On Mars wheels slide for longer, and for longer still where the rover is simulated faster than
// real: what motors that jump cost does not hang on the step there, either.
TEST(ChangeOfSpeed, JumpsOfAFastMarsRoverLoseAsMuchAt60HzAsAt480Hz) {
  const terrain::Terrain terrain = Level(terrain::SoilPreset::kMarsDrift);
  const auto way_m = [&](double rate_Hz) {
    RoverParams params = WithRamp(0.0, rate_Hz);
    params.physics.gravity_m_s2 = 3.72;
    params.drive.speed_m_s = 0.0067;
    params.physics.time_scale = 18.0;
    const auto rover = PlacedRover(params, terrain);
    const double from_m = rover->state().X_WR.translation().x();
    for (int i = 0; i < 3; ++i) {
      RunFor(*rover, Drive(params, params.drive.speed_m_s, 0.0), 7.2);
      RunFor(*rover, kBraked, 1.8);
    }
    return rover->state().X_WR.translation().x() - from_m;
  };
  const double fine_m = way_m(480.0);
  EXPECT_NEAR(way_m(60.0), fine_m, 0.003 * fine_m);
}

// Its widest level meets the front of the chassis halfway up.
terrain::Rock BeltHighRock() { return MakeRock(0.4, 0.0, 0.2, 0.1, 0.1, 0.06); }

// Motors that jump get parts of steps; a rock that the rover pushes along, and that slides on when
// the brakes are on, knows nothing of them.
TEST(ChangeOfSpeed, ALooseRockGoesAsFarAt60HzAsAt960Hz) {
  terrain::RockHoldingParams holding{.rock_density_kg_m3 = 1000.0};
  const auto pushed_m = [&](double rate_Hz) {
    RoverParams params = WithRamp(0.0, rate_Hz);
    params.contact.body_rock_friction = 0.0;
    terrain::Terrain terrain = FlatTerrain({BeltHighRock()});
    const auto rover = MakeRover(params, holding, terrain);
    rover->Place({});
    for (int i = 0; i < 3; ++i) {
      RunFor(*rover, Drive(params, 0.15, 0.0), 0.4);
      RunFor(*rover, kBraked, 0.2);
    }
    return terrain.rocks()[0].center_W.x() - BeltHighRock().center_W.x();
  };
  const double fine_m = pushed_m(960.0);
  EXPECT_GT(fine_m, 0.05);
  EXPECT_NEAR(pushed_m(60.0), fine_m, 0.01 * fine_m);
}

// A rock that slides freely loses speed at the rate F / m, also where steps change their length on
// the way.
TEST(ChangeOfSpeed, SoilBrakesALooseRockAtItsRateInStepsOfAnyLength) {
  constexpr double kGravity_m_s2 = 9.81;
  terrain::RockHoldingParams holding{.rock_density_kg_m3 = 1000.0};
  terrain::Terrain terrain = FlatTerrain({BeltHighRock()});
  const terrain::Rock rock = terrain.rocks()[0];
  const double mass_kg = terrain::RockMass(rock, holding.rock_density_kg_m3);
  const double slowing_m_s2 =
      terrain::HoldingForce(rock, holding, kGravity_m_s2, 0.0, math::Vector3::UnitX()) / mass_kg;
  LooseRocks rocks(holding, kGravity_m_s2, 1.0 / 60.0, terrain);
  Contact contact;
  contact.other = 0;
  contact.active = true;
  rocks.Start({contact});
  constexpr double kStart_m_s = 1.0;
  rocks.Find(0)->PushBack(-mass_kg * kStart_m_s * math::Vector3::UnitX());
  double speed_m_s = kStart_m_s;
  bool first = true;
  for (const double step_s : {1.0 / 60.0, 1.0 / 960.0, 1.0 / 960.0, 1.0 / 60.0, 1.0 / 240.0}) {
    if (!first) {
      rocks.SetStep(step_s);
      rocks.Start({});
    }
    first = false;
    for (int sweep = 0; sweep < 3; ++sweep) rocks.Hold();
    speed_m_s -= slowing_m_s2 * step_s;
    ASSERT_GT(speed_m_s, 0.0);
    ASSERT_NE(rocks.Find(0), nullptr);
    EXPECT_NEAR(rocks.Find(0)->v_W_m_s.x(), speed_m_s, 1e-12) << step_s;
  }
}

}  // namespace
}  // namespace rockyard::rover
