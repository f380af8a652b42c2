#include "rover/multibody/joint_space_inertia.h"

#include <Eigen/LU>
#include <array>
#include <cstddef>

#include "core/check.h"

namespace rockyard::rover {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::RowVector2d;
using math::Vector3;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix62 = Eigen::Matrix<double, 6, 2>;

// The joints of one side, which the mass matrix does not couple with those of the other.
struct SideJoints {
  int rocker;
  int bogie;
  std::array<int, 3> wheels;
};
constexpr std::array<SideJoints, 2> kSides{
    {{kLeftRocker, kLeftBogie, {kFirstWheel, kFirstWheel + 1, kFirstWheel + 2}},
     {kRightRocker, kRightBogie, {kFirstWheel + 3, kFirstWheel + 4, kFirstWheel + 5}}}};

std::array<int, 5> All(const SideJoints& side) {
  return {side.rocker, side.bogie, side.wheels[0], side.wheels[1], side.wheels[2]};
}

// A joint turns about the y axis of the body that it carries.
Vector3 Axis_W(const Multibody& body, int joint) { return body.X_WB(joint).linear().col(1); }

// Mass, first moment and moment of inertia of some bodies about a point P, in W.
struct CompositeInertia {
  double mass_kg = 0.0;
  Vector3 moment_kg_m = Vector3::Zero();  // sum of m p over the bodies, p from P
  Matrix3d inertia_kg_m2 = Matrix3d::Zero();
};

// Returns the inertia of one body about its centre of mass: R diag(I) R' with the body's axes as
// columns of R.
CompositeInertia Single(const BodyMass& body, const Matrix3d& R_WB) {
  return {body.mass_kg, Vector3::Zero(), R_WB * body.inertia_kg_m2.asDiagonal() * R_WB.transpose()};
}

// Returns the inertia of a wheel, whose moments across the axle a are equal:
// I_x 1 + (I_y - I_x) a a'.
CompositeInertia SingleWheel(const BodyMass& wheel, const Vector3& axle_W) {
  const double across = wheel.inertia_kg_m2.x();
  return {wheel.mass_kg, Vector3::Zero(),
          across * Matrix3d::Identity() +
              (wheel.inertia_kg_m2.y() - across) * axle_W * axle_W.transpose()};
}

// Adds to `sum`, about P, the bodies of `part`, about a point Q at d from P. With h the first
// moment about Q and s = h + m d / 2, Huygens and Steiner's theorem reads I_P = I_Q + 2 (d . s) 1 -
// d s' - s d'.
void AddAt(const Vector3& d_m, const CompositeInertia& part, CompositeInertia& sum) {
  const Vector3 s = part.moment_kg_m + 0.5 * part.mass_kg * d_m;
  const Matrix3d outer = d_m * s.transpose();
  sum.mass_kg += part.mass_kg;
  sum.moment_kg_m += part.moment_kg_m + part.mass_kg * d_m;
  sum.inertia_kg_m2 += part.inertia_kg_m2 - outer - outer.transpose();
  sum.inertia_kg_m2.diagonal().array() += 2.0 * d_m.dot(s);
}

// Fills row and column of a joint. While the joint alone turns at unit rate about its axis a, all
// that hangs on it, with h and I about the joint, has the momentum p = a x h and the angular
// momentum l = I a about the joint. The entries are p and the angular momentum about the centre of
// the chassis, and for each ancestor the angular momentum about the ancestor's axis.
void FillJoint(const Multibody& body, int joint, const CompositeInertia& carried, DofMatrix& mass) {
  const Vector3 axis = Axis_W(body, joint);
  const Vector3 p = axis.cross(carried.moment_kg_m);
  const Vector3 l = carried.inertia_kg_m2 * axis;
  const auto about = [&](const Vector3& point) -> Vector3 {
    return l + (body.X_WB(joint).translation() - point).cross(p);
  };
  const int column = 6 + joint;
  mass.block<3, 1>(0, column) = about(body.p_WComChassis());
  mass.block<3, 1>(3, column) = p;
  for (int k = joint; k != kChassis; k = body.Parent(k)) {
    mass(6 + k, column) = Axis_W(body, k).dot(about(body.X_WB(k).translation()));
    mass(column, 6 + k) = mass(6 + k, column);
  }
  mass.block<1, 6>(column, 0) = mass.block<6, 1>(0, column).transpose();
}

// Fills the block of the chassis with the inertia of the whole rover about the chassis' centre:
// angular momentum I w + h x v, momentum m v + w x h.
void FillChassis(const CompositeInertia& rover, DofMatrix& mass) {
  const Vector3& h = rover.moment_kg_m;
  Matrix3d cross;  // cross v = h x v
  cross << 0.0, -h.z(), h.y(), h.z(), 0.0, -h.x(), -h.y(), h.x(), 0.0;
  mass.block<3, 3>(0, 0) = rover.inertia_kg_m2;
  mass.block<3, 3>(0, 3) = cross;
  mass.block<3, 3>(3, 0) = cross.transpose();
  mass.block<3, 3>(3, 3) = rover.mass_kg * Matrix3d::Identity();
}

// What joints without torque do: their rates by the velocity of the chassis (T), by the rates of
// rocker and bogie of their side (U), and the rates of these two by unit torques on them (N).
struct FreeJoints {
  Eigen::Matrix<double, kJoints, 6> by_chassis = Eigen::Matrix<double, kJoints, 6>::Zero();
  Eigen::Matrix<double, kJoints, 2> by_arms = Eigen::Matrix<double, kJoints, 2>::Zero();
  std::array<Matrix2d, 2> arms_by_torque;
};

// Lets the joints of a side turn freely: wheels first, then the arms. No torque acts about a
// wheel's axle a, so that its spin is
//   s = -a . w - (a . y) (rocker rate + bogie rate),
// w the chassis' rate, y the axis of the arms; the bogie's rate counts where the wheel hangs on it.
// The wheel's moment of inertia I about the axle then drops out of the matrices of the chassis, A,
// of the arms, H, and of their coupling, B. Free arms move at -H^-1 B' v, and the chassis is left
// with A - B H^-1 B'.
void FreeSide(const Multibody& body, std::size_t index, double spin_kg_m2, const DofMatrix& mass,
              FreeJoints& joints, Matrix6& chassis) {
  const SideJoints& side = kSides[index];
  const int r = 6 + side.rocker;
  const int b = 6 + side.bogie;
  Matrix62 coupling;
  coupling << mass.block<6, 1>(0, r), mass.block<6, 1>(0, b);
  Matrix2d arms{{mass(r, r), mass(r, b)}, {mass(b, r), mass(b, b)}};
  for (const int wheel : side.wheels) {
    const Vector3 axle = Axis_W(body, wheel);
    const double follows = -axle.dot(Axis_W(body, side.rocker));
    const RowVector2d by_arms(follows, body.Parent(wheel) == side.bogie ? follows : 0.0);
    joints.by_arms.row(wheel) = by_arms;
    joints.by_chassis.block<1, 3>(wheel, 0) = -axle.transpose();
    chassis.topLeftCorner<3, 3>() -= spin_kg_m2 * axle * axle.transpose();
    coupling.topRows<3>() += spin_kg_m2 * axle * by_arms;
    arms -= spin_kg_m2 * by_arms.transpose() * by_arms;
  }
  joints.by_arms(side.rocker, 0) = 1.0;
  joints.by_arms(side.bogie, 1) = 1.0;
  joints.arms_by_torque[index] = arms.inverse();
  const Matrix62 by_chassis = -coupling * joints.arms_by_torque[index];
  chassis += by_chassis * coupling.transpose();
  for (const int joint : All(side)) {
    joints.by_chassis.row(joint) += joints.by_arms.row(joint) * by_chassis.transpose();
  }
}

// Returns the inverse of a symmetric positive definite matrix of 3 x 3 blocks, by the last block's
// Schur complement.
Matrix6 InverseOfBlocks(const Matrix6& m) {
  const Matrix3d last = m.bottomRightCorner<3, 3>().inverse();
  const Matrix3d follows = last * m.bottomLeftCorner<3, 3>();
  const Matrix3d first = (m.topLeftCorner<3, 3>() - m.topRightCorner<3, 3>() * follows).inverse();
  const Matrix3d coupling = follows * first;
  Matrix6 inverse;
  inverse.topLeftCorner<3, 3>() = first;
  inverse.bottomLeftCorner<3, 3>() = -coupling;
  inverse.topRightCorner<3, 3>() = -coupling.transpose();
  inverse.bottomRightCorner<3, 3>() = last + coupling * follows.transpose();
  return inverse;
}

}  // namespace

JointSpaceInertia::JointSpaceInertia(const RoverParams& params) : masses_(MakeRoverMasses(params)) {
  // MakeRoverMasses promises what FillMass and FillInverse take for granted.
  EXPECT(masses_.rocker.com_B.isZero() && masses_.bogie.com_B.isZero() &&
         masses_.wheel.com_B.isZero());
  EXPECT(masses_.wheel.inertia_kg_m2.x() == masses_.wheel.inertia_kg_m2.z());
}

void JointSpaceInertia::Update(const Multibody& body) {
  FillMass(body);
  FillInverse(body);
}

void JointSpaceInertia::FillMass(const Multibody& body) {
  CompositeInertia rover = Single(masses_.chassis, body.X_WR().linear());
  for (const SideJoints& side : kSides) {
    const math::Transform& X_rocker = body.X_WB(side.rocker);
    const math::Transform& X_bogie = body.X_WB(side.bogie);
    CompositeInertia rocker = Single(masses_.rocker, X_rocker.linear());
    CompositeInertia bogie = Single(masses_.bogie, X_bogie.linear());
    for (const int joint : side.wheels) {
      const CompositeInertia wheel = SingleWheel(masses_.wheel, Axis_W(body, joint));
      FillJoint(body, joint, wheel, mass_);
      const bool on_bogie = body.Parent(joint) == side.bogie;
      const Vector3& pivot = (on_bogie ? X_bogie : X_rocker).translation();
      AddAt(body.X_WB(joint).translation() - pivot, wheel, on_bogie ? bogie : rocker);
    }
    FillJoint(body, side.bogie, bogie, mass_);
    AddAt(X_bogie.translation() - X_rocker.translation(), bogie, rocker);
    FillJoint(body, side.rocker, rocker, mass_);
    AddAt(X_rocker.translation() - body.p_WComChassis(), rocker, rover);
  }
  FillChassis(rover, mass_);
}

// With S the matrix of the chassis while all joints are free (FreeSide),
//   M^-1 = [1; T] S^-1 [1, T'] + [0, 0; 0, U N U' for either side, 1/I for the spin of a wheel].
void JointSpaceInertia::FillInverse(const Multibody& body) {
  const double spin_kg_m2 = masses_.wheel.inertia_kg_m2.y();
  FreeJoints joints;
  Matrix6 chassis = mass_.topLeftCorner<6, 6>();
  for (std::size_t i = 0; i < 2; ++i) FreeSide(body, i, spin_kg_m2, mass_, joints, chassis);
  const Matrix6 chassis_by_force = InverseOfBlocks(chassis);
  // Lazy products spare Eigen's packing of blocks, which such small ones do not repay.
  const Eigen::Matrix<double, kJoints, 6> by_force =
      joints.by_chassis.lazyProduct(chassis_by_force);
  inverse_.topLeftCorner<6, 6>() = chassis_by_force;
  inverse_.bottomLeftCorner<kJoints, 6>() = by_force;
  inverse_.topRightCorner<6, kJoints>() = by_force.transpose();
  inverse_.bottomRightCorner<kJoints, kJoints>() =
      by_force.lazyProduct(joints.by_chassis.transpose());
  for (std::size_t side = 0; side < 2; ++side) {
    for (const int i : All(kSides[side])) {
      const RowVector2d rates = joints.by_arms.row(i) * joints.arms_by_torque[side];
      for (const int k : All(kSides[side])) {
        inverse_(6 + i, 6 + k) += rates.dot(joints.by_arms.row(k));
      }
    }
    for (const int wheel : kSides[side].wheels) inverse_(6 + wheel, 6 + wheel) += 1.0 / spin_kg_m2;
  }
}

}  // namespace rockyard::rover
