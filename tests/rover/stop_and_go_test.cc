// Stops and starts, where trials live: what the step makes of them, and what they cost.
#include "stop_and_go.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "rover/multibody/loose_rocks.h"
#include "soil_reference.h"
#include "terrain/rock.h"

namespace rockyard::rover {
namespace {

struct Ground {
  const char* name;
  terrain::SoilPreset soil;
  double slope_deg;  // to which the rover gets uphill
};
// The rover spins on drift from 11 deg on.
constexpr Ground kGrounds[] = {{"landscaping_sand", terrain::SoilPreset::kLandscapingSand, 15.0},
                               {"mars_drift", terrain::SoilPreset::kMarsDrift, 6.0},
                               {"hard_ground", terrain::SoilPreset::kHardGround, 15.0}};
constexpr double kUphill = 0.0;
constexpr double kAcross = 0.5 * std::numbers::pi;
constexpr double kDownhill = std::numbers::pi;

RoverParams AtRate(double rate_Hz, double ramp_s) {
  return RoverParams{.drive = {.ramp_s = ramp_s}, .physics = {.step_s = 1.0 / rate_Hz}};
}

// At both rates, to half a per cent or to `least` of the rims' way.
void ExpectSameWay(double ramp_s, const terrain::Terrain& terrain, double least) {
  const LegResult coarse = DriveLegs(AtRate(60.0, ramp_s), terrain, 4);
  const LegResult fine = DriveLegs(AtRate(960.0, ramp_s), terrain, 4);
  EXPECT_NEAR(coarse.along, fine.along, std::max(0.005 * fine.along, least));
  EXPECT_NEAR(coarse.across, fine.across, 0.005);
}

// The way of a rover that starts and stops is that of a step sixteen times finer, on three soils,
// level, up, down and across, whether its motors jump or ramp gently.
TEST(StopAndGo, WayAt60HzIsThatAt960Hz) {
  for (const Ground& ground : kGrounds) {
    const terrain::SoilParams soil = terrain::MakeSoil(ground.soil);
    for (const double ramp_s : {0.0, 0.2}) {
      for (const double direction : {-1.0, kUphill, kAcross, kDownhill}) {
        const double slope = direction < 0.0 ? 0.0 : math::DegToRad(ground.slope_deg);
        const terrain::Terrain terrain = SlopeTerrain(slope, std::max(direction, 0.0), soil);
        SCOPED_TRACE(testing::Message()
                     << ground.name << ", ramp " << ramp_s << ", direction " << direction);
        ExpectSameWay(ramp_s, terrain, 0.0);
      }
    }
  }
}

// Also on slopes of drift where it does not get uphill any more: there, a thousandth of the rims'
// way.
TEST(StopAndGo, WayOnSteepDriftAt60HzIsThatAt960Hz) {
  const terrain::SoilParams soil = terrain::MakeSoil(terrain::SoilPreset::kMarsDrift);
  for (const double slope_deg : {12.0, 15.0}) {
    for (const double ramp_s : {0.0, 0.2}) {
      for (const double direction : {kUphill, kAcross, kDownhill}) {
        const terrain::Terrain terrain = SlopeTerrain(math::DegToRad(slope_deg), direction, soil);
        SCOPED_TRACE(testing::Message()
                     << slope_deg << " deg, ramp " << ramp_s << ", direction " << direction);
        ExpectSameWay(ramp_s, terrain, 0.001);
      }
    }
  }
}

// A point mass under the same soil, by midpoint steps of 20 us: velocity v of the rover, rim speed
// u.
//   m dv/dt = sign(u - v) T_max tau(|u - v| / u) - R sign(v),   a braked wheel with tau = 1.
double PointMassWay(double ramp_s) {
  const SoilReference soil;
  const double mass_kg = 20.0 / 6.0;
  const double load_N = mass_kg * 9.81;
  const double most_N = soil.LargestTraction(load_N);
  const double drag_N = soil.Resistance(load_N);
  const double ratio = soil.ContactLength(load_N) / soil.soil.shear_modulus_m;
  const double top_m_s = 0.15;
  const auto rim = [&](double t) {
    if (ramp_s == 0.0) return t < kLegDrive_s ? top_m_s : 0.0;
    const double up = top_m_s * t / ramp_s;
    const double down = top_m_s * (1.0 - (t - kLegDrive_s) / ramp_s);
    return std::clamp(std::min(up, down), 0.0, top_m_s);
  };
  const auto force = [&](double v, double u) {
    const double slip = u > 0.0 ? std::min(std::abs(u - v) / u, 1.0) : 1.0;
    const double x = slip * ratio;
    const double share = u > 0.0 ? (x > 1e-9 ? 1.0 - (1.0 - std::exp(-x)) / x : 0.0) : 1.0;
    return std::copysign(most_N * share, u - v) - drag_N;
  };
  constexpr double kStep_s = 2e-5;
  double v = 0.0;
  double way_m = 0.0;
  double rolled_m = 0.0;
  const int steps = static_cast<int>((kLegDrive_s + ramp_s + kLegRest_s) / kStep_s);
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) * kStep_s;
    const double half = v + 0.5 * kStep_s * force(v, rim(t)) / mass_kg;
    const double next = v + kStep_s * force(half, rim(t)) / mass_kg;
    way_m += 0.5 * kStep_s * (v + std::max(next, 0.0));
    v = std::max(next, 0.0);  // brakes and drag stop, they do not push back
    rolled_m += kStep_s * rim(t);
  }
  return way_m / rolled_m;
}

// A third opinion beside two levels that could share an error. The rover loses a little more than a
// point: it pitches, and its wheels carry unequal loads meanwhile.
TEST(StopAndGo, CostsWhatItCostsAPointMass) {
  const terrain::Terrain terrain = FlatTerrain();
  for (const auto& [ramp_s, margin] :
       {std::pair{0.0, 0.015}, {0.05, 0.008}, {0.1, 0.005}, {0.2, 0.005}}) {
    const double point = PointMassWay(ramp_s);
    RoverParams params = AtRate(60.0, ramp_s);
    EXPECT_NEAR(DriveLegs(params, terrain, 4).along, point, margin) << ramp_s;
    params.fidelity = Fidelity::kQuasiStatic;
    EXPECT_NEAR(DriveLegs(params, terrain, 4).along, point, margin) << ramp_s;
  }
}

// Both levels, at the steps that trials take.
TEST(StopAndGo, BothLevelsLoseTheSame) {
  for (const Ground& ground : kGrounds) {
    const terrain::SoilParams soil = terrain::MakeSoil(ground.soil);
    for (const double ramp_s : {0.0, 0.1, 0.2}) {
      for (const double direction : {-1.0, kUphill, kAcross, kDownhill}) {
        const double slope = direction < 0.0 ? 0.0 : math::DegToRad(ground.slope_deg);
        const terrain::Terrain terrain = SlopeTerrain(slope, std::max(direction, 0.0), soil);
        RoverParams params = AtRate(60.0, ramp_s);
        const LegResult multibody = DriveLegs(params, terrain, 4);
        params.fidelity = Fidelity::kQuasiStatic;
        const LegResult quasi_static = DriveLegs(params, terrain, 4);
        // Without a ramp the rover pitches, which only the multibody knows.
        const double margin = ramp_s == 0.0 ? 0.02 : 0.01;
        EXPECT_NEAR(quasi_static.along, multibody.along, margin)
            << ground.name << ", ramp " << ramp_s << ", direction " << direction;
        EXPECT_NEAR(quasi_static.across, multibody.across, 2.0 * margin)
            << ground.name << ", ramp " << ramp_s << ", direction " << direction;
      }
    }
  }
}

TEST(StopAndGo, SweepsDecideNothing) {
  const terrain::Terrain terrain = FlatTerrain();
  RoverParams params = AtRate(60.0, 0.0);
  const double few = DriveLegs(params, terrain, 4).along;
  params.physics.solver_iterations = 80;
  EXPECT_NEAR(few, DriveLegs(params, terrain, 4).along, 1e-3);
}

TEST(StopAndGo, BrakingDoesNotBounce) {
  const terrain::Terrain terrain = FlatTerrain();
  for (const double ramp_s : {0.0, 0.1}) {
    const RoverParams params = AtRate(60.0, ramp_s);
    const auto rover = PlacedRover(params, terrain);
    RunFor(*rover, Drive(params, 0.15, 0.0), 1.0);
    double slowest_m_s = 1.0;
    for (int i = 0; i < 30; ++i) {
      rover->Step(kBraked);
      slowest_m_s = std::min(slowest_m_s, rover->state().v_WR_m_s.x());
    }
    // R's origin swings with the chassis that nods; a tenth of what it did when motor and friction
    // were solved apart.
    EXPECT_GT(slowest_m_s, -2e-3) << ramp_s;
  }
}

// Wheels that stall hold the rover on a slope: their torque bears the weight downhill, but not the
// motion resistance on top. They creep neither up nor down.
TEST(StopAndGo, AStalledRoverHoldsOn20Degrees) {
  const double slope = math::DegToRad(20.0);
  RoverParams params = AtRate(60.0, 0.1);
  const double pull_N = Weights(params).total_N * std::sin(slope) / messages::kWheelCount;
  params.drive.stall_torque_Nm = 1.1 * pull_N * params.geometry.wheel_radius_m;
  const RoverOn rover(SlopeTerrain(slope, kUphill), params);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  RunFor(*rover, command, 2.0);
  const math::Vector3 from = rover->state().X_WR.translation();
  RunFor(*rover, command, 10.0);
  // The light front wheels spin on the spot, the others stall.
  const messages::PerWheel<double>& torque_Nm = rover->state().motor_torque_Nm;
  EXPECT_NEAR(*std::max_element(torque_Nm.begin(), torque_Nm.end()), params.drive.stall_torque_Nm,
              1e-6);
  EXPECT_LT((rover->state().X_WR.translation() - from).norm(), 1e-3);
}

// With a ramp that wheels follow without sliding, steps need no parts; without one they get them,
// and the rover is as far as with steps that are short throughout.
TEST(StopAndGo, TurnsInPlaceLikeFineSteps) {
  for (const double ramp_s : {0.0, 0.1}) {
    const auto heading = [&](double rate_Hz) {
      const RoverParams params = AtRate(rate_Hz, ramp_s);
      const RoverOn rover(FlatTerrain(), params);
      const messages::WheelCommand turn = Drive(params, 0.0, 0.4);
      RunFor(*rover, SteerOnly(turn), 1.0);
      for (int i = 0; i < 4; ++i) {
        RunFor(*rover, turn, kLegDrive_s);
        RunFor(*rover, SteerOnly(turn), params.drive.ramp_s + kLegRest_s);
      }
      return math::Heading(rover->state().X_WR);
    };
    EXPECT_NEAR(heading(60.0), heading(960.0), 0.005 * heading(960.0)) << ramp_s;
  }
}

// Reversals, steep ramps, slow rovers and loose rocks: what the length of a step makes of a change
// of speed.

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
  Contact contact{.other = 0, .active = true};
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
