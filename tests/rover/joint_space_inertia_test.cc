// Mass matrix, inverse, poses and forces of motion against Bullet's articulated bodies and against
// energies of points.
#include "rover/multibody/joint_space_inertia.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "rover/multibody/bullet_rover.h"
#include "rover/random_numbers.h"
#include "rover/rover_drive.h"
#include "rover/rover_layout_params.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

struct Configuration {
  math::Transform X_WR = math::Transform::Identity();
  std::array<double, kJoints> joint_rad{};
  messages::PerWheel<double> steer_rad{};
};

// Any attitude, joints and steering beyond what their stops allow.
Configuration RandomConfiguration(Numbers& numbers) {
  Configuration c;
  const Eigen::Vector4d q(numbers.Next(), numbers.Next(), numbers.Next(), numbers.Next());
  c.X_WR.linear() = Eigen::Quaterniond(q.normalized()).toRotationMatrix();
  c.X_WR.translation() = 5.0 * Vector3(numbers.Next(), numbers.Next(), numbers.Next());
  for (double& angle : c.joint_rad) angle = 1.5 * numbers.Next();
  for (double& angle : c.steer_rad) angle = 1.5 * numbers.Next();
  return c;
}

DofVector RandomVelocity(Numbers& numbers) {
  DofVector v;
  for (double& value : v) value = numbers.Next();
  return v;
}

void SetConfiguration(const Configuration& c, Multibody& body) {
  body.Reset(c.X_WR);
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) body.SetSteer(i, c.steer_rad[i]);
  // Joints turn to their angles at constant rates within a second.
  DofVector rates = DofVector::Zero();
  for (int joint = 0; joint < kJoints; ++joint) {
    rates[6 + joint] = c.joint_rad[static_cast<std::size_t>(joint)];
  }
  body.AddVelocity(rates);
  body.Move(1.0);
  body.StopMotion();
  body.UpdatePoses();
}

// Masses that differ in everything, with bogies at either end and the middle wheels off the middle.
RoverParams Uneven(BogieEnd end) {
  return RoverParams{.geometry = {.middle_wheel_x_m = 0.01, .bogie_end = end},
                     .mass = {.total_kg = 17.0,
                              .wheel_kg = 0.7,
                              .rocker_kg = 1.3,
                              .bogie_kg = 0.4,
                              .chassis_com_x_m = 0.023,
                              .chassis_com_z_m = 0.21}};
}

// Kinetic energy body by body, 1/2 m v^2 + 1/2 w . I w, with the velocities of each joint's origin
// and body from those of its parent.
double KineticEnergy_J(const RoverParams& params, const Multibody& body, const DofVector& v) {
  const RoverMasses masses = MakeRoverMasses(params);
  const auto energy_J = [](const BodyMass& mass, const Vector3& w_B, const Vector3& v_m_s) {
    return 0.5 * mass.mass_kg * v_m_s.squaredNorm() +
           0.5 * w_B.dot(mass.inertia_kg_m2.asDiagonal() * w_B);
  };
  const Vector3 w_chassis = v.head<3>();
  const Vector3 v_chassis = v.segment<3>(3);
  double sum_J = energy_J(masses.chassis, body.X_WR().linear().transpose() * w_chassis, v_chassis);
  std::array<Vector3, kJoints> w_W;
  std::array<Vector3, kJoints> v_W;
  for (int joint = 0; joint < kJoints; ++joint) {
    const auto i = static_cast<std::size_t>(joint);
    const math::Transform& X = body.X_WB(joint);
    const int parent = body.Parent(joint);
    const bool on_chassis = parent == kChassis;
    const auto p = static_cast<std::size_t>(on_chassis ? 0 : parent);
    const Vector3 w = on_chassis ? w_chassis : w_W[p];
    const Vector3 from =
        X.translation() - (on_chassis ? body.p_WComChassis() : body.X_WB(parent).translation());
    v_W[i] = (on_chassis ? v_chassis : v_W[p]) + w.cross(from);
    w_W[i] = w + v[6 + joint] * X.linear().col(1);
    const BodyMass& mass = joint <= kRightRocker ? masses.rocker
                           : joint < kFirstWheel ? masses.bogie
                                                 : masses.wheel;
    sum_J += energy_J(mass, X.linear().transpose() * w_W[i], v_W[i]);
  }
  return sum_J;
}

class JointSpaceInertiaOf : public testing::TestWithParam<BogieEnd> {};

INSTANTIATE_TEST_SUITE_P(Ends, JointSpaceInertiaOf,
                         testing::Values(BogieEnd::kFront, BogieEnd::kRear), [](const auto& end) {
                           return end.param == BogieEnd::kFront ? "BogiesInFront" : "BogiesBehind";
                         });

// Entries of the inverse differ in size by their units, 1/kg beside 1/(kg m2): each is compared
// with the geometric mean of the two on the diagonal, the most that it can be.
TEST_P(JointSpaceInertiaOf, RoverHasTheInverseThatUnitForcesShow) {
  const RoverParams params = Uneven(GetParam());
  Multibody body(params);
  BulletRover bullet(params);
  JointSpaceInertia inertia(params);
  for (std::uint32_t i = 0; i < 200; ++i) {
    Numbers numbers(i);
    const Configuration c = RandomConfiguration(numbers);
    SetConfiguration(c, body);
    inertia.Update(body);
    bullet.Take(body);
    const DofMatrix expected = bullet.Inverse();
    const DofVector scale = expected.diagonal().cwiseSqrt();
    const DofMatrix difference = (inertia.Inverse() - expected).cwiseAbs();
    EXPECT_LT(difference.cwiseQuotient(scale * scale.transpose()).maxCoeff(), 1e-9) << i;
  }
}

// Falls and tumbles: what gravity, centrifugal and gyroscopic forces do in one step, and where all
// bodies are after it.
TEST_P(JointSpaceInertiaOf, RoverFallsAsBulletsDoes) {
  constexpr double kGravity_m_s2 = 9.81;
  constexpr double kStep_s = 1.0 / 60.0;
  const RoverParams params = Uneven(GetParam());
  Multibody body(params);
  BulletRover bullet(params);
  JointSpaceInertia inertia(params);
  for (std::uint32_t i = 0; i < 200; ++i) {
    Numbers numbers(3000 + i);
    const Configuration c = RandomConfiguration(numbers);
    SetConfiguration(c, body);
    const DofVector v = 3.0 * RandomVelocity(numbers);
    body.AddVelocity(v);
    bullet.Take(body);
    const DofVector gain = bullet.Fall(kGravity_m_s2, kStep_s);
    bullet.Move(kStep_s);
    inertia.Update(body);
    body.AddVelocity(kStep_s * inertia.Accelerations(body.FreeForce(kGravity_m_s2)));
    EXPECT_LT((body.Velocity() - v - gain).norm(), 1e-11 * gain.norm()) << i;
    body.Move(kStep_s);
    body.UpdatePoses();
    EXPECT_LT((body.p_WComChassis() - bullet.ComChassis()).norm(), 1e-12) << i;
    for (int joint = 0; joint < kJoints; ++joint) {
      EXPECT_LT((body.X_WB(joint).translation() - bullet.Origin(joint)).norm(), 1e-12) << i;
      EXPECT_LT((body.X_WB(joint).linear().col(1) - bullet.Axis(joint)).norm(), 1e-12) << i;
    }
  }
}

// A drive over a rock by Bullet's accelerations is the same drive.
TEST(JointSpaceInertia, DrivesByBulletsAccelerationsAreTheSame) {
  const terrain::Terrain terrain = FlatTerrain({MakeRock(0.5, 0.2, 0.0, 0.12, 0.12, 0.05)});
  RoverParams params;
  std::array<math::Transform, 2> ends;
  for (const Dynamics dynamics : {Dynamics::kRockyard, Dynamics::kBullet}) {
    params.physics.dynamics = dynamics;
    const auto rover = PlacedRover(params, terrain);
    RunFor(*rover, Drive(params, 0.15, 0.1), 4.0);
    ends[dynamics == Dynamics::kBullet ? 1 : 0] = rover->state().X_WR;
  }
  EXPECT_LT((ends[0].matrix() - ends[1].matrix()).norm(), 1e-6);
  EXPECT_GT((ends[0].matrix() - ends[1].matrix()).norm(), 0.0) << "of other roundings";
}

// To velocities in which the mass is 1 and back; their square is twice the energy, and forces do
// the same work on rows as on Jacobians.
TEST_P(JointSpaceInertiaOf, RoverHasTheMassOneInUnitVelocities) {
  const RoverParams params = Uneven(GetParam());
  Multibody body(params);
  JointSpaceInertia inertia(params);
  for (std::uint32_t i = 0; i < 200; ++i) {
    Numbers numbers(4000 + i);
    SetConfiguration(RandomConfiguration(numbers), body);
    inertia.Update(body);
    const DofVector v = RandomVelocity(numbers);
    const UnitVelocity z = inertia.ToUnit(v);
    EXPECT_LT((inertia.FromUnit(z) - v).norm(), 1e-12) << i;
    double square = z.chassis.squaredNorm() + z.arms[0].squaredNorm() + z.arms[1].squaredNorm();
    for (const double wheel : z.wheels) square += wheel * wheel;
    EXPECT_NEAR(square, v.dot(inertia.mass() * v), 1e-12 * square) << i;
    const Vector3 p_W = 5.0 * Vector3(numbers.Next(), numbers.Next(), numbers.Next());
    const Vector3 n_W = Vector3(numbers.Next(), numbers.Next(), numbers.Next()).normalized();
    for (int index = kChassis; index < kJoints; ++index) {
      DofVector J;
      body.FillJacobian(index, p_W, n_W, J);
      const UnitRow row = inertia.OfPoint(body, index, p_W, n_W);
      EXPECT_NEAR(row.Velocity(z), J.dot(v), 1e-11) << i << ", body " << index;
      UnitVelocity pushed = z;
      row.Push(0.1, pushed);
      const DofVector change = inertia.FromUnit(pushed) - v;
      EXPECT_LT((inertia.mass() * change - 0.1 * J).norm(), 1e-11 * (1.0 + J.norm()))
          << i << ", body " << index;
    }
  }
}

TEST_P(JointSpaceInertiaOf, RoverHasTheEnergyOfItsBodies) {
  const RoverParams params = Uneven(GetParam());
  Multibody body(params);
  JointSpaceInertia inertia(params);
  for (std::uint32_t i = 0; i < 200; ++i) {
    Numbers numbers(1000 + i);
    SetConfiguration(RandomConfiguration(numbers), body);
    inertia.Update(body);
    const DofVector v = RandomVelocity(numbers);
    const double energy_J = KineticEnergy_J(params, body, v);
    EXPECT_NEAR(0.5 * v.dot(inertia.mass() * v), energy_J, 1e-12 * energy_J) << i;
  }
}

TEST_P(JointSpaceInertiaOf, RoverIsSymmetricPositiveAndInverse) {
  const RoverParams params = Uneven(GetParam());
  Multibody body(params);
  JointSpaceInertia inertia(params);
  for (std::uint32_t i = 0; i < 200; ++i) {
    Numbers numbers(2000 + i);
    SetConfiguration(RandomConfiguration(numbers), body);
    inertia.Update(body);
    const DofMatrix& mass = inertia.mass();
    const DofMatrix inverse = inertia.Inverse();
    EXPECT_LT((mass - mass.transpose()).cwiseAbs().maxCoeff(), 1e-14) << i;
    EXPECT_LT((inverse - inverse.transpose()).cwiseAbs().maxCoeff(),
              1e-12 * inverse.cwiseAbs().maxCoeff())
        << i;
    EXPECT_LT((mass * inverse - DofMatrix::Identity()).cwiseAbs().maxCoeff(), 1e-9) << i;
    EXPECT_EQ(Eigen::MatrixXd(mass).llt().info(), Eigen::Success) << i << ": is not positive";
  }
}

// A rover that stands level with straight wheels, by hand: its total mass and moment, a wheel's
// spin against its ancestors, and no coupling between the sides or among wheels.
TEST(JointSpaceInertia, LevelRoverHasTheEntriesOfLeversAndSpins) {
  const RoverParams params;
  const RoverMasses masses = MakeRoverMasses(params);
  Multibody body(params);
  JointSpaceInertia inertia(params);
  inertia.Update(body);
  const DofMatrix& mass = inertia.mass();
  const double spin_kg_m2 = masses.wheel.inertia_kg_m2.y();
  EXPECT_NEAR(mass(3, 3), params.mass.total_kg, 1e-12);
  for (int wheel = kFirstWheel; wheel < kJoints; ++wheel) {
    EXPECT_NEAR(mass(6 + wheel, 6 + wheel), spin_kg_m2, 1e-15);
    EXPECT_NEAR(mass(1, 6 + wheel), spin_kg_m2, 1e-15);
    EXPECT_NEAR(mass(6 + body.Parent(wheel), 6 + wheel), spin_kg_m2, 1e-15);
    EXPECT_EQ(mass.block(3, 6 + wheel, 3, 1).norm(), 0.0);
    const int other_side = wheel < kFirstWheel + 3 ? kRightRocker : kLeftRocker;
    EXPECT_EQ(mass(6 + other_side, 6 + wheel), 0.0);
    for (int other = kFirstWheel; other < wheel; ++other) {
      EXPECT_EQ(mass(6 + other, 6 + wheel), 0.0);
    }
  }
  EXPECT_EQ(mass.block(6 + kLeftRocker, 6 + kRightRocker, 1, 1).norm(), 0.0);
  EXPECT_EQ(mass.block(6 + kLeftBogie, 6 + kRightBogie, 1, 1).norm(), 0.0);
}

}  // namespace
}  // namespace rockyard::rover
