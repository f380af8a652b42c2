// The rover on level ground against closed forms; rough ground, blow-up, geometry for the on-board
// copy.
#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

#include "rover/multibody/constraint_solver.h"
#include "rover/multibody/joint_space_inertia.h"
#include "rover/wheel_soil.h"
#include "rover_drive.h"
#include "soil_reference.h"

namespace rockyard::rover {
namespace {

using messages::kWheelCount;

class LevelGround : public ::testing::Test {
 protected:
  void Start() {
    rover_ = MakeRover(params_, terrain_);
    rover_->Place({});
  }
  const truth::RoverState& state() const { return rover_->state(); }
  double x() const { return state().X_WR.translation().x(); }

  RoverParams params_;
  terrain::Terrain terrain_ = FlatTerrain();
  std::unique_ptr<Rover> rover_;
};

// The wheels sink into the soil and by the contact's own spring.
TEST_F(LevelGround, StandsAsDeepAsItsWheelsSink) {
  Start();
  RunFor(*rover_, kBraked, 1.0);
  const double load_N = params_.mass.total_kg * params_.physics.gravity_m_s2 / 6.0;
  const double depth_m = SoilReference().Sinkage(load_N) + load_N / params_.contact.stiffness_N_m;
  EXPECT_NEAR(state().X_WR.translation().z(), -depth_m, 0.02 * depth_m);
  EXPECT_LT(math::Tilt(state().X_WR), math::DegToRad(0.1));
  EXPECT_TRUE(state().contacts.empty());
}

// Slip on level ground comes from the motion resistance alone: the traction of six wheels at that
// slip is the sum of their resistances.
TEST_F(LevelGround, DrivesStraightWithTheSlipOfItsDrag) {
  Start();
  const messages::WheelCommand command = Drive(params_, 0.15, 0.0);
  RunFor(*rover_, command, 2.0);
  const double x0 = x();
  const double angle0 = state().wheel_angle_rad[0];
  RunFor(*rover_, command, 10.0);
  const double rolled_m = (state().wheel_angle_rad[0] - angle0) * params_.geometry.wheel_radius_m;
  EXPECT_NEAR(rolled_m, 1.5, 1e-3);
  const SoilReference soil;
  const messages::PerWheel<double>& loads_N = state().wheel_load_N;
  const double slip = soil.SlipForPull(soil.SumResistance(loads_N), loads_N);
  EXPECT_NEAR(1.0 - (x() - x0) / rolled_m, slip, 0.002);
  RecordProperty("slip", std::to_string(1.0 - (x() - x0) / rolled_m));
  EXPECT_NEAR(state().X_WR.translation().y(), 0.0, 2e-3);
  EXPECT_NEAR(math::Heading(state().X_WR), 0.0, 2e-3);
}

// Turning about the centre every wheel runs on a circle, at one slip i for all: the rover turns by
// (1 - i) of what its rims cover, with sum of d_i (T_i(i) - R_i) = 0 over the circles' radii d_i.
TEST_F(LevelGround, TurnsInPlaceAboutItsCentre) {
  Start();
  const double rate_rad_s = 0.3;
  const messages::WheelCommand command = Drive(params_, 0.0, rate_rad_s);
  RunFor(*rover_, SteerOnly(command), 1.5);
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    EXPECT_NEAR(state().steer_rad[i], command.steer_rad[i], 1e-9);
  }
  const double from_rad = math::Heading(state().X_WR);
  RunFor(*rover_, command, 5.0);
  const SoilReference soil;
  const RoverGeometry geometry = MakeRoverGeometry(params_.geometry);
  const double slip = Bisect(0.0, 1.0, [&](double trial) {
    double moment_Nm = 0.0;
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      const double load_N = state().wheel_load_N[i];
      moment_Nm +=
          geometry.wheel_R[i].head<2>().norm() *
          (soil.Share(trial, load_N) * soil.LargestTraction(load_N) - soil.Resistance(load_N));
    }
    return moment_Nm;
  });
  const double turned_rad = math::Heading(state().X_WR) - from_rad;
  EXPECT_NEAR(turned_rad, (1.0 - slip) * 5.0 * rate_rad_s, 0.01 * turned_rad);
  EXPECT_LT(state().X_WR.translation().head<2>().norm(), 0.01);
}

// The motors work against the resistance of the soil alone: torque = r R on each wheel.
TEST_F(LevelGround, MotorsDeliverTheResistance) {
  Start();
  RunFor(*rover_, Drive(params_, 0.15, 0.0), 6.0);
  const double torque_Nm =
      std::accumulate(state().motor_torque_Nm.begin(), state().motor_torque_Nm.end(), 0.0);
  const double expected_Nm =
      params_.geometry.wheel_radius_m * SoilReference().SumResistance(state().wheel_load_N);
  EXPECT_NEAR(torque_Nm, expected_Nm, 0.01 * expected_Nm);
}

TEST_F(LevelGround, FollowsAnArcOfTheCommandedRadius) {
  Start();
  const double radius_m = 1.0;
  const messages::WheelCommand command = Drive(params_, 0.12, 0.12 / radius_m);
  RunFor(*rover_, SteerOnly(command), 1.0);
  const math::Pose2 from = math::ToPose2(state().X_WR);
  RunFor(*rover_, command, 8.0);
  const math::Pose2 to = math::ToPose2(state().X_WR);
  const double turned_rad = math::WrapAngle(to.heading_rad - from.heading_rad);
  const double chord_m = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  EXPECT_NEAR(0.5 * chord_m / std::sin(0.5 * turned_rad), radius_m, 0.02 * radius_m);
}

TEST_F(LevelGround, SteeringIsLimitedInRateAndAngle) {
  Start();
  messages::WheelCommand command;
  command.steer_rad.fill(2.0);
  rover_->Step(command);
  EXPECT_NEAR(state().steer_rad[0], params_.drive.steer_rate_rad_s * rover_->step_s(), 1e-12);
  RunFor(*rover_, command, 2.0);
  EXPECT_NEAR(state().steer_rad[0], params_.drive.max_steer_rad, 1e-12);
  EXPECT_EQ(state().steer_rad[1], 0.0);  // middle wheels do not steer
}

TEST_F(LevelGround, MotorsStayWithinStallTorque) {
  params_.drive.stall_torque_Nm = 0.05;  // less than the drag needs
  Start();
  RunFor(*rover_, Drive(params_, 0.15, 0.0), 3.0);
  for (const double torque_Nm : state().motor_torque_Nm) EXPECT_LE(std::abs(torque_Nm), 0.05);
  EXPECT_LT(x(), 0.05);
}

TEST_F(LevelGround, PlaceKeepsTheWheelAnglesAndStopsTheRover) {
  Start();
  RunFor(*rover_, Drive(params_, 0.15, 0.0), 2.0);
  const messages::PerWheel<double> angle = state().wheel_angle_rad;
  EXPECT_GT(angle[0], 4.0);
  rover_->Place({1.0, 2.0, 0.5});
  EXPECT_EQ(state().v_WR_m_s.norm(), 0.0);
  EXPECT_NEAR(x(), 1.0, 1e-3);
  EXPECT_NEAR(math::Heading(state().X_WR), 0.5, 1e-3);
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    EXPECT_NEAR(state().wheel_angle_rad[i], angle[i], 1e-12);
  }
}

TEST_F(LevelGround, PlaceOnARockSettlesOnIt) {
  terrain_ = FlatTerrain({MakeRock(0.26, 0.2, 0.0, 0.15, 0.15, 0.1)});
  Start();
  EXPECT_GT(Pitch(state().X_WR), -math::DegToRad(15.0));
  EXPECT_LT(Pitch(state().X_WR), -math::DegToRad(1.0));  // nose up
  EXPECT_GT(state().wheel_load_N[0], 1.0);
  const math::Vector3 before = state().X_WR.translation();
  RunFor(*rover_, kBraked, 2.0);
  EXPECT_LT((state().X_WR.translation() - before).norm(), 0.005);
}

TEST(RoughGround, CarriesTheRoverWithoutSnagging) {
  const RoverParams params;
  terrain::GroundParams ground{.roughness_rms_m = 0.02};
  const terrain::Terrain terrain(terrain::Ground(ground, {}), {}, {});
  const auto rover = PlacedRover(params, terrain);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  for (int i = 0; i < 1200; ++i) {
    rover->Step(command);
    const math::Vector3 p_W = rover->state().X_WR.translation();
    ASSERT_NEAR(p_W.z(), terrain.Height(p_W.x(), p_W.y()), 0.06);
  }
  EXPECT_GT(rover->state().X_WR.translation().norm(), 2.7);
}

TEST(Fault, AFallIsReported) {
  const RoverParams params;
  const RoverOn rover(SlopeTerrain(math::DegToRad(60.0), 0.0, RigidGround(0.0)), params);
  EXPECT_THROW(RunFor(*rover, kBraked, 3.0), std::runtime_error);
}

TEST(Geometry, CalibrationIsTheTrueGeometry) {
  const RoverParams params;
  const messages::DriveCalibration c = MakeDriveCalibration(params);
  EXPECT_EQ(c.wheel_radius_m, 0.065);
  EXPECT_NEAR(c.wheel_x_m[messages::Index(messages::Wheel::kLeftFront)], 0.26, 1e-12);
  EXPECT_NEAR(c.wheel_y_m[messages::Index(messages::Wheel::kRightRear)], -0.20, 1e-12);
  EXPECT_TRUE(c.steered[messages::Index(messages::Wheel::kRightFront)]);
  EXPECT_FALSE(c.steered[messages::Index(messages::Wheel::kRightMiddle)]);
  EXPECT_EQ(BodyOutline(params.geometry)[2], std::make_pair(0.325, 0.24));
}

TEST(Geometry, BogiesInFrontMirrorBogiesBehind) {
  RoverGeometryParams params{.bogie_end = BogieEnd::kRear};
  const RoverGeometry rear = MakeRoverGeometry(params);
  params.bogie_end = BogieEnd::kFront;
  const RoverGeometry front = MakeRoverGeometry(params);
  EXPECT_EQ(front.bogie_pivot_R[0].x(), -rear.bogie_pivot_R[0].x());
  EXPECT_TRUE(front.on_bogie[0] && front.on_bogie[1] && !front.on_bogie[2]);
  EXPECT_TRUE(!rear.on_bogie[0] && rear.on_bogie[1] && rear.on_bogie[2]);
}

// A braked rover: it comes to rest, does not creep, and never gains energy.

// The parts of a step without Rover around them, so that every velocity can be seen.
class BrakedBody {
 public:
  BrakedBody(const RoverParams& params, const terrain::Terrain& terrain)
      : params_(params),
        weights_(params),
        soil_(MakeWheelOnSoil(params, terrain.ground().soil())),
        body_(params),
        inertia_(params),
        finder_(params.geometry, terrain),
        solver_(params, terrain.ground().soil()) {}

  void Drop(const math::Transform& X_WR) { body_.Reset(X_WR); }

  void Step() {
    body_.UpdatePoses();
    finder_.Update(body_);
    const DofVector before = body_.Velocity();
    inertia_.Update(body_);
    body_.AddVelocity(params_.physics.step_s *
                      inertia_.Accelerations(body_.FreeForce(params_.physics.gravity_m_s2)));
    solver_.Solve({inertia_, before, {}, params_.physics.step_s}, nullptr, finder_, body_);
    body_.Move(params_.physics.step_s);
  }

  // Kinetic energy of all parts, their height, and what the contacts' springs and the soil under
  // the wheels store.
  double Energy_J() {
    body_.UpdatePoses();
    finder_.Update(body_);
    inertia_.Update(body_);
    const DofVector v = body_.Velocity();
    double energy_J = 0.5 * v.dot(inertia_.mass() * v);
    energy_J += weights_.chassis_N * body_.p_WComChassis().z();
    for (int joint = 0; joint < kJoints; ++joint) {
      const double weight_N = joint <= kRightRocker ? weights_.rocker_N
                              : joint < kFirstWheel ? weights_.bogie_N
                                                    : weights_.wheel_N;
      energy_J += weight_N * body_.X_WB(joint).translation().z();
    }
    for (const Contact& contact : finder_.contacts()) {
      const double depth_m = std::max(0.0, -contact.gap_m);
      const bool on_soil =
          contact.IsSoil() && finder_.part(contact.part).kind == truth::BodyPart::kWheel;
      energy_J +=
          on_soil ? SoilEnergy_J(depth_m) : 0.5 * params_.contact.stiffness_N_m * depth_m * depth_m;
    }
    return energy_J;
  }

  double Speed() const { return body_.Velocity().norm(); }

 private:
  // Integral of the load N over the depth z(N) + N / k.
  double SoilEnergy_J(double depth_m) const {
    const double k = params_.contact.stiffness_N_m;
    const auto sinkage_m = [&](double load) {
      return load > 0.0 ? soil_.Under(load, 0.0).sinkage_m : 0.0;
    };
    const double load_N =
        Bisect(0.0, k * depth_m, [&](double load) { return sinkage_m(load) + load / k - depth_m; });
    // int N dz = N z - int z dN, by the midpoint rule.
    constexpr int kCells = 40;
    double rest_J = 0.0;
    for (int i = 0; i < kCells; ++i) {
      rest_J += sinkage_m(load_N * (i + 0.5) / kCells) * load_N / kCells;
    }
    return load_N * sinkage_m(load_N) - rest_J + 0.5 * load_N * load_N / k;
  }

  const RoverParams params_;
  const Weights weights_;
  const WheelOnSoil soil_;
  Multibody body_;
  JointSpaceInertia inertia_;
  ContactFinder finder_;
  ConstraintSolver solver_;
};

math::Transform Lifted(double height_m, double roll_rad, double pitch_rad) {
  math::Transform X_WR = math::Transform::Identity();
  X_WR.linear() = (Eigen::AngleAxisd(pitch_rad, math::Vector3::UnitY()) *
                   Eigen::AngleAxisd(roll_rad, math::Vector3::UnitX()))
                      .toRotationMatrix();
  X_WR.translation().z() = height_m;
  return X_WR;
}

// Largest gain in one step from a drop to the rest ten seconds later, of
//   E = 1/2 v M v + sum m g z + 1/2 k d^2
// and, under wheels, the work of the sinkage law, which rebounds as the springs do.
double LargestGain_J(double step_s, const terrain::SoilParams& soil, const math::Transform& X_WR,
                     const std::vector<terrain::Rock>& rocks) {
  RoverParams params{.physics = {.step_s = step_s}};
  terrain::GroundParams ground{.soil = soil};
  const terrain::Terrain terrain(terrain::Ground(ground, {}), rocks, {});
  BrakedBody body(params, terrain);
  body.Drop(X_WR);
  double last_J = body.Energy_J();
  double gain_J = 0.0;
  for (int i = 0; i < std::lround(10.0 / step_s); ++i) {
    body.Step();
    const double energy_J = body.Energy_J();
    gain_J = std::max(gain_J, energy_J - last_J);
    last_J = energy_J;
  }
  EXPECT_LT(body.Speed(), 1e-6);
  return gain_J;
}

// A contact's normal turns while it rolls or slides within one step, which the step does not see:
// some (v h)^2 / 2 r of depth, 20 um at 0.1 m/s, times a force of 50 N, is the bound of 1 to 2 mJ
// (of 30 J that a drop takes away), and it shrinks with the square of the step.
TEST(Energy, NeverGrowsFromADropToTheRest) {
  const std::vector<terrain::Rock> rocks{MakeRock(0.26, 0.2, 0.0, 0.15, 0.15, 0.08),
                                         MakeRock(-0.2, -0.2, 0.0, 0.12, 0.2, 0.06)};
  for (const double rate_Hz : {60.0, 240.0}) {
    const double bound_J = 2e-3 * std::pow(60.0 / rate_Hz, 2.0);
    for (const terrain::SoilParams& soil :
         {RigidGround(0.8), terrain::MakeSoil(terrain::SoilPreset::kLandscapingSand),
          terrain::MakeSoil(terrain::SoilPreset::kMarsDrift)}) {
      SCOPED_TRACE(testing::Message()
                   << rate_Hz << " Hz, sinkage exponent " << soil.sinkage_exponent);
      const double step_s = 1.0 / rate_Hz;
      EXPECT_LT(LargestGain_J(step_s, soil, Lifted(0.02, 0.0, 0.0), {}), bound_J);
      EXPECT_LT(LargestGain_J(step_s, soil, Lifted(0.06, 0.09, -0.09), {}), bound_J);
      EXPECT_LT(LargestGain_J(step_s, soil, Lifted(0.12, 0.0, 0.0), rocks), bound_J);
    }
  }
}

TEST(Rest, BrakedRoverDoesNotCreep) {
  const std::vector<terrain::Rock> rocks{MakeRock(0.26, 0.2, 0.0, 0.15, 0.15, 0.08),
                                         MakeRock(-0.2, -0.2, 0.0, 0.12, 0.2, 0.06)};
  for (const double slope_deg : {0.0, 12.0, 20.0}) {
    for (const auto& on : {std::vector<terrain::Rock>{}, rocks}) {
      if (slope_deg > 0.0 && !on.empty()) continue;  // rocks stand on level ground
      terrain::GroundParams ground{.slope_rad = math::DegToRad(slope_deg),
                                   .slope_direction_rad = 0.7};
      const RoverOn rover(terrain::Terrain(terrain::Ground(ground, {}), on, {}));
      RunFor(*rover, kBraked, 5.0);
      const math::Vector3 from = rover->state().X_WR.translation();
      double fastest_m_s = 0.0;
      for (int i = 0; i < 1800; ++i) {
        rover->Step(kBraked);
        fastest_m_s = std::max(fastest_m_s, rover->state().v_WR_m_s.norm());
      }
      EXPECT_LT(fastest_m_s, 1e-6) << slope_deg;
      EXPECT_LT((rover->state().X_WR.translation() - from).norm(), 1e-6) << slope_deg;
    }
  }
}

}  // namespace
}  // namespace rockyard::rover
