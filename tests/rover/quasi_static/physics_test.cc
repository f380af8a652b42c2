// The quasi-static rover against closed forms.
#include <gtest/gtest.h>

#include <numbers>

#include "rover/rover_drive.h"
#include "rover/soil_reference.h"
#include "rover/wheel_soil.h"

namespace rockyard::rover {
namespace {

constexpr double kUphill = 0.0;
constexpr double kLeftUp = std::numbers::pi / 2;

RoverParams QuasiStatic() { return WithFidelity(Fidelity::kQuasiStatic); }

double Sum(const messages::PerWheel<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum;
}

TEST(QuasiStaticLevel, WheelsBearTheWeightAndSinkAsTheSoilSays) {
  const RoverParams params = QuasiStatic();
  const terrain::Terrain terrain = FlatTerrain();
  const auto rover = PlacedRover(params, terrain, {1.0, 2.0, 0.5});
  const truth::RoverState& state = rover->state();
  EXPECT_NEAR(Sum(state.wheel_load_N), Weights(params).total_N, 0.01);
  EXPECT_NEAR(math::Heading(state.X_WR), 0.5, 1e-6);
  EXPECT_NEAR(state.X_WR.translation().x(), 1.0, 1e-6);
  // All wheels carry about a sixth: R's origin sinks by the sinkage under it and the contact's own
  // spring.
  const double load_N = Weights(params).total_N / 6.0;
  const BekkerWheel soil(terrain.ground().soil(), params.geometry.wheel_radius_m,
                         params.geometry.wheel_width_m);
  const double depth_m = soil.Sinkage_m(load_N) + load_N / params.contact.stiffness_N_m;
  EXPECT_NEAR(state.X_WR.translation().z(), -depth_m, 2e-4);
}

TEST(QuasiStaticLevel, SteeringIsLimitedInRateAndAngle) {
  const RoverParams params = QuasiStatic();
  const RoverOn rover(FlatTerrain(), params);
  messages::WheelCommand command;
  command.steer_rad.fill(2.0);
  rover->Step(command);
  const messages::PerWheel<double>& steer_rad = rover->state().steer_rad;
  EXPECT_NEAR(steer_rad[0], params.drive.steer_rate_rad_s * rover->step_s(), 1e-12);
  RunFor(*rover, command, 2.0);
  EXPECT_NEAR(steer_rad[0], params.drive.max_steer_rad, 1e-12);
  EXPECT_EQ(steer_rad[1], 0.0) << "middle wheels do not steer";
}

// Wheels that are steered on the way turn the rover from there on, in the middle of a stretch too.
TEST(QuasiStaticLevel, SteeringOnTheWayTurnsTheRoverAtOnce) {
  RoverParams params = QuasiStatic();
  params.quasi_static.settle_distance_m = 0.1;
  params.drive.steer_rate_rad_s = 100.0;
  const terrain::Terrain terrain = FlatTerrain();
  for (const double curvature_per_m : {0.2, 1.0}) {
    const auto rover = PlacedRover(params, terrain);
    const double speed_m_s = 0.1;
    RunFor(*rover, Drive(params, speed_m_s, 0.0), 1.2);
    const double heading_rad = math::Heading(rover->state().X_WR);
    messages::WheelCommand curve = Drive(params, speed_m_s, curvature_per_m * speed_m_s);
    // The wheels roll on as they do: nothing but their angles changes.
    curve.rate_rad_s = Drive(params, speed_m_s, 0.0).rate_rad_s;
    const double way_m = 0.07;
    RunFor(*rover, curve, way_m / speed_m_s);
    EXPECT_GT(math::Heading(rover->state().X_WR) - heading_rad, 0.4 * curvature_per_m * way_m);
  }
}

// Wheels that share one slip i: sum tau(i) T_max = sum R. How finely the way is cut says nothing.
TEST(QuasiStaticLevel, WayIsThatOfTheSlipLawHoweverFineTheStretches) {
  const terrain::Terrain terrain = FlatTerrain();
  for (const double settle_distance_m : {0.02, 0.01, 0.005, 0.0025}) {
    RoverParams params = QuasiStatic();
    params.quasi_static.settle_distance_m = settle_distance_m;
    const auto rover = PlacedRover(params, terrain);
    RunFor(*rover, Drive(params, 0.15, 0.0), 1.0);
    const double from_m = rover->state().X_WR.translation().x();
    RunFor(*rover, Drive(params, 0.15, 0.0), 20.0);
    const messages::PerWheel<double>& load_N = rover->state().wheel_load_N;
    const SoilReference soil{terrain.ground().soil()};
    const double slip = soil.SlipForPull(soil.SumResistance(load_N), load_N);
    const double way_m = 0.15 * 20.0 * (1.0 - slip);
    EXPECT_NEAR(rover->state().X_WR.translation().x() - from_m, way_m, 1e-3 * way_m)
        << settle_distance_m;
  }
}

// Levers about the bogie pivots: equal arms share a bogie's load equally.
TEST(QuasiStaticLevel, BogieSharesItsLoadByLevers) {
  const RoverParams params = QuasiStatic();
  const RoverOn rover(FlatTerrain(), params);
  const messages::PerWheel<double>& load_N = rover->state().wheel_load_N;
  EXPECT_NEAR(load_N[0], load_N[1], 0.1);
  EXPECT_NEAR(load_N[0], load_N[3], 1e-3);
  // Moments about the rocker pivot: bogie pivot and rear wheel, less what hangs there itself.
  const RoverGeometry geometry = MakeRoverGeometry(params.geometry);
  const Weights weights(params);
  const double pivot_x = geometry.rocker_pivot_R[0].x();
  const double bogie_N = load_N[0] + load_N[1] - 2.0 * weights.wheel_N - weights.bogie_N;
  const double rear_N = load_N[2] - weights.wheel_N;
  // The rockers are held level by each other: the moments of both sides are equal, not zero. The
  // chassis' own moment about the pivots closes the balance.
  const double moment_Nm = 2.0 * (bogie_N * (geometry.bogie_pivot_R[0].x() - pivot_x) +
                                  rear_N * (geometry.wheel_R[2].x() - pivot_x));
  EXPECT_NEAR(moment_Nm, weights.chassis_N * (params.mass.chassis_com_x_m - pivot_x), 0.05);
}

// 1 - v / (omega r) is the slip at which the soil mobilizes slope and motion resistance.
TEST(QuasiStaticSlope, SlipFollowsTheSoil) {
  for (const double slope_deg : {0.0, 5.0, 10.0, 15.0}) {
    const RoverParams params = QuasiStatic();
    const double slope = math::DegToRad(slope_deg);
    const terrain::Terrain terrain = SlopeTerrain(slope, kUphill);
    const auto rover = PlacedRover(params, terrain);
    const messages::WheelCommand command = Drive(params, 0.15, 0.0);
    RunFor(*rover, command, 2.0);
    const math::Vector3 from = rover->state().X_WR.translation();
    RunFor(*rover, command, 4.0);
    const double slip = 1.0 - (rover->state().X_WR.translation() - from).norm() / 0.6;
    // Every wheel slips by as much, so the tractions at that slip must carry the weight downhill
    // and the resistance.
    const BekkerWheel soil(terrain.ground().soil(), params.geometry.wheel_radius_m,
                           params.geometry.wheel_width_m);
    double traction_N = 0.0;
    double resistance_N = 0.0;
    for (const double load_N : rover->state().wheel_load_N) {
      traction_N += soil.LargestTraction_N(load_N) * soil.TractionShare(slip, load_N);
      resistance_N += soil.Resistance_N(load_N);
    }
    const double needed_N = Weights(params).total_N * std::sin(slope) + resistance_N;
    EXPECT_NEAR(traction_N, needed_N, 0.02 * needed_N) << slope_deg;
    EXPECT_NEAR(Sum(rover->state().wheel_load_N), Weights(params).total_N * std::cos(slope), 0.1);
  }
}

// 1 - v / (omega r) on every soil, hard ground included, which has no slip: both levels.
TEST(QuasiStaticSlope, WayIsThatOfTheClosedFormOnEverySoil) {
  for (const auto preset : {terrain::SoilPreset::kLandscapingSand, terrain::SoilPreset::kMarsDrift,
                            terrain::SoilPreset::kHardGround}) {
    const terrain::SoilParams soil = BekkerSoil(preset);
    for (const double slope_deg : {-20.0, -10.0, 0.0, 5.0, 10.0, 15.0, 20.0}) {
      const double slope = math::DegToRad(std::abs(slope_deg));
      const terrain::Terrain terrain =
          SlopeTerrain(slope, slope_deg < 0.0 ? std::numbers::pi : kUphill, soil);
      for (const Fidelity fidelity : {Fidelity::kMultibody, Fidelity::kQuasiStatic}) {
        const RoverParams params = WithFidelity(fidelity);
        const auto rover = PlacedRover(params, terrain);
        const messages::WheelCommand command = Drive(params, 0.15, 0.0);
        RunFor(*rover, command, 2.0);
        const truth::RoverState from = rover->state();
        RunFor(*rover, command, 4.0);
        const truth::RoverState& to = rover->state();
        const double rolled_m =
            params.geometry.wheel_radius_m * (to.wheel_angle_rad[0] - from.wheel_angle_rad[0]);
        const math::Vector3 moved = to.X_WR.translation() - from.X_WR.translation();
        const SoilReference reference{soil};
        const double pull_N = std::copysign(Weights(params).total_N * std::sin(slope), slope_deg) +
                              reference.SumResistance(to.wheel_load_N);
        const double slip = reference.SlipForPull(pull_N, to.wheel_load_N);
        EXPECT_NEAR(moved.dot(from.X_WR.linear().col(0)) / rolled_m, 1.0 - slip, 0.01)
            << soil.sinkage_exponent << ", " << slope_deg << " deg";
        // Of the slip itself 2 %, or what stands for rigid contact on hard ground.
        EXPECT_NEAR(1.0 - moved.dot(from.X_WR.linear().col(0)) / rolled_m, slip,
                    0.02 * std::abs(slip) + 5e-3)
            << soil.sinkage_exponent << ", " << slope_deg << " deg";
      }
    }
  }
}

// Held by its brakes on a slope, the rover's wheels carry W cos together, at once after it was put
// down.
TEST(QuasiStaticSlope, WheelsCarryTheNormalPartOfTheWeight) {
  for (const double slope_deg : {5.0, 15.0, 25.0}) {
    for (const double direction : {kUphill, kLeftUp, 0.7}) {
      const RoverParams params = QuasiStatic();
      const double slope = math::DegToRad(slope_deg);
      const RoverOn rover(SlopeTerrain(slope, direction), params);
      EXPECT_NEAR(Sum(rover->state().wheel_load_N), Weights(params).total_N * std::cos(slope),
                  1e-3 * Weights(params).total_N)
          << slope_deg;
    }
  }
}

// Braked, a rover stands up to the friction angle and slides beyond it, down the fall line.
TEST(QuasiStaticSlope, BrakedRoverSlidesBeyondTheFrictionAngle) {
  for (const double excess_deg : {-1.0, 1.0}) {
    const RoverParams params = QuasiStatic();
    const double slope = std::atan(0.5) + math::DegToRad(excess_deg);
    const RoverOn rover(SlopeTerrain(slope, kLeftUp, RigidGround(0.5)), params);
    const math::Vector3 from = rover->state().X_WR.translation();
    RunFor(*rover, kBraked, 2.0);
    const math::Vector3 moved = rover->state().X_WR.translation() - from;
    if (excess_deg < 0.0) {
      EXPECT_LT(moved.norm(), 1e-3);
    } else {
      EXPECT_LT(moved.y(), -0.05);
      EXPECT_LT(std::abs(moved.x()), 0.1 * std::abs(moved.y()));
    }
  }
}

// Soil without strength: wheels that spin do not get on, neither forward nor, on a slope, back.
TEST(QuasiStaticSlope, NothingCreepsWhereNothingCanMove) {
  terrain::SoilParams soil{.law = terrain::WheelLaw::kBekker,
                           .cohesion_Pa = 0.0,
                           .friction_angle_rad = math::DegToRad(3.0)};
  const RoverParams params = QuasiStatic();
  for (const double slope_deg : {0.0, 5.0}) {
    const RoverOn rover(SlopeTerrain(math::DegToRad(slope_deg), kUphill, soil), params);
    const math::Vector3 from = rover->state().X_WR.translation();
    RunFor(*rover, Drive(params, 0.15, 0.0), 10.0);
    // The referee calls a rover stuck that moved less than 2 cm in ten seconds.
    EXPECT_LT((rover->state().X_WR.translation() - from).norm(), 0.02) << slope_deg;
  }
}

// Beyond what a slip of 1 mobilizes the wheels turn on the spot or the rover slides back.
TEST(QuasiStaticSlope, SteepSandIsNotClimbed) {
  const RoverParams params = QuasiStatic();
  const RoverOn rover(SlopeTerrain(math::DegToRad(28.0), kUphill), params);
  RunFor(*rover, Drive(params, 0.15, 0.0), 5.0);
  EXPECT_LT(rover->state().X_WR.translation().x(), 0.05);
  EXPECT_NEAR(rover->state().wheel_angle_rad[0] * params.geometry.wheel_radius_m, 0.75, 0.01);
}

TEST(QuasiStaticSlope, TipsOverSidewaysAtTheStaticAngle) {
  const RoverParams params = QuasiStatic();
  const double height = Weights(params).com_z_m;
  const double middle_y = 0.5 * (params.geometry.width_m - params.geometry.wheel_width_m);
  const double edge_y = 0.5 * params.geometry.width_m;
  const auto tilt_after = [&](double slope) {
    terrain::GroundParams ground{.slope_rad = slope,
                                 .slope_direction_rad = kLeftUp,
                                 .soil = BekkerSoil(terrain::SoilPreset::kHardGround)};
    ground.soil.friction_angle_rad = math::DegToRad(60.0);  // holds until it tips
    const RoverOn rover(terrain::Terrain(terrain::Ground(ground, {}), {}, {}), params);
    RunFor(*rover, Drive(params, 0.15, 0.0), 2.0);
    return math::Tilt(rover->state().X_WR) - slope;
  };
  EXPECT_LT(std::abs(tilt_after(std::atan(middle_y / height) - math::DegToRad(2.0))),
            math::DegToRad(3.0));
  EXPECT_GT(tilt_after(std::atan(edge_y / height) + math::DegToRad(2.0)), math::DegToRad(15.0));
}

TEST(QuasiStaticDrive, TurnsInPlaceAboutItsCentre) {
  const RoverParams params = QuasiStatic();
  const terrain::Terrain terrain = FlatTerrain();
  const auto rover = PlacedRover(params, terrain);
  const messages::WheelCommand command = Drive(params, 0.0, 0.4);
  RunFor(*rover, SteerOnly(command), 1.0);
  RunFor(*rover, command, 1.0);
  const double from_rad = math::Heading(rover->state().X_WR);
  RunFor(*rover, command, 3.0);
  const math::Transform& X = rover->state().X_WR;
  EXPECT_LT(X.translation().head<2>().norm(), 0.005);
  // Every wheel rolls along its own circle and slips by what its motion resistance asks for.
  const BekkerWheel soil(terrain.ground().soil(), params.geometry.wheel_radius_m,
                         params.geometry.wheel_width_m);
  const double load_N = Weights(params).total_N / 6.0;
  const double share = soil.Resistance_N(load_N) / soil.LargestTraction_N(load_N);
  const double slip =
      Bisect(0.0, 1.0, [&](double i) { return soil.TractionShare(i, load_N) - share; });
  EXPECT_NEAR(math::Heading(X) - from_rad, 1.2 * (1.0 - slip), 0.01);
}

TEST(QuasiStaticDrive, FollowsTheArcOfItsSteering) {
  const RoverParams params = QuasiStatic();
  const RoverOn rover(FlatTerrain(), params);
  const messages::WheelCommand command = Drive(params, 0.1, 0.1);  // radius 1 m
  RunFor(*rover, SteerOnly(command), 1.0);
  RunFor(*rover, command, 10.0);
  const math::Transform& X = rover->state().X_WR;
  // The chord of an arc: sin(heading / 2) = chord / (2 R).
  EXPECT_NEAR(X.translation().head<2>().norm() / (2.0 * std::sin(0.5 * math::Heading(X))), 1.0,
              0.02);
}

// Put down anew while it drives, the rover stands with straight wheels and motors at rest.
TEST(QuasiStaticDrive, StandsWhereItIsPutWhileItDrives) {
  const RoverParams params = QuasiStatic();
  const RoverOn rover(FlatTerrain(), params);
  RunFor(*rover, Drive(params, 0.15, 0.0), 2.0);
  rover->Place({3.0, 0.0, 0.0});
  RunFor(*rover, kBraked, 1.0);
  EXPECT_NEAR(rover->state().X_WR.translation().x(), 3.0, 1e-9);
  EXPECT_EQ(rover->state().v_WR_m_s.norm(), 0.0);
}

// Wheels sink as the soil says at their load, on soil alone; half a stretch ahead on level ground
// is the same place.
TEST(QuasiStaticDrive, StatesTheSinkageOfItsWheels) {
  for (const Fidelity fidelity : {Fidelity::kMultibody, Fidelity::kQuasiStatic}) {
    const RoverParams params = WithFidelity(fidelity);
    const terrain::Terrain terrain = FlatTerrain();
    const auto rover = PlacedRover(params, terrain);
    RunFor(*rover, Drive(params, 0.15, 0.0), 2.0);
    const SoilReference soil{terrain.ground().soil()};
    for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
      const double load_N = rover->state().wheel_load_N[i];
      EXPECT_NEAR(rover->state().wheel_sinkage_m[i], soil.Sinkage(load_N), 2e-5);
    }
  }
}

// A wheel steered while the brakes are on, or commanded the other way before it has come to rest,
// leaves finite rates and no jump.
TEST(QuasiStaticDrive, ChangesOfMindGiveNoJumps) {
  const RoverParams params = QuasiStatic();
  const RoverOn rover(FlatTerrain({MakeRock(0.5, 0.2, 0.0, 0.1, 0.08, 0.07)}), params);
  const messages::WheelCommand commands[] = {
      Drive(params, 0.15, 0.0), SteerOnly(Drive(params, 0.0, 0.4)), Drive(params, -0.15, 0.0),
      Drive(params, 0.15, 0.0), Drive(params, 0.0, -0.4),           Drive(params, 0.1, 0.3)};
  math::Vector3 last = rover->state().X_WR.translation();
  for (int i = 0; i < 600; ++i) {
    rover->Step(commands[(i / 3) % 6]);
    const math::Vector3 now = rover->state().X_WR.translation();
    ASSERT_TRUE(now.allFinite()) << i;
    EXPECT_LT((now - last).norm(), 0.02) << i;
    last = now;
  }
}

TEST(QuasiStatic, EqualCallsGiveEqualBits) {
  const RoverParams params = QuasiStatic();
  const terrain::Terrain terrain = FlatTerrain({MakeRock(0.5, 0.2, 0.0, 0.1, 0.08, 0.07)});
  const auto drive = [&] {
    const auto rover = PlacedRover(params, terrain, {0.0, 0.01, 0.1});
    RunFor(*rover, Drive(params, 0.15, 0.05), 8.0);
    return rover->state();
  };
  const truth::RoverState a = drive();
  const truth::RoverState b = drive();
  EXPECT_TRUE(a.X_WR.matrix() == b.X_WR.matrix());
  EXPECT_EQ(a.wheel_load_N, b.wheel_load_N);
  EXPECT_EQ(a.wheel_angle_rad, b.wheel_angle_rad);
}

}  // namespace
}  // namespace rockyard::rover
