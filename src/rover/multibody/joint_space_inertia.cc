#include "rover/multibody/joint_space_inertia.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "core/check.h"

namespace rockyard::rover {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::RowVector2d;
using math::Vector3;
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

// Returns L of m = L L' with L lower triangular (Cholesky). m: symmetric and positive definite.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> LowerRoot(const Eigen::Matrix<double, kSize, kSize>& m) {
  Eigen::Matrix<double, kSize, kSize> L = Eigen::Matrix<double, kSize, kSize>::Zero();
  for (int j = 0; j < kSize; ++j) {
    double pivot = m(j, j);
    for (int k = 0; k < j; ++k) pivot -= L(j, k) * L(j, k);
    L(j, j) = std::sqrt(pivot);
    const double inverse = 1.0 / L(j, j);
    for (int i = j + 1; i < kSize; ++i) {
      double sum = m(i, j);
      for (int k = 0; k < j; ++k) sum -= L(i, k) * L(j, k);
      L(i, j) = inverse * sum;
    }
  }
  return L;
}

// Returns the inverse of a lower triangular matrix.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> LowerInverse(const Eigen::Matrix<double, kSize, kSize>& L) {
  Eigen::Matrix<double, kSize, kSize> inverse = Eigen::Matrix<double, kSize, kSize>::Zero();
  for (int j = 0; j < kSize; ++j) {
    inverse(j, j) = 1.0 / L(j, j);
    for (int i = 0; i < j; ++i) {
      double sum = 0.0;
      for (int k = i; k < j; ++k) sum -= L(j, k) * inverse(k, i);
      inverse(j, i) = inverse(j, j) * sum;
    }
  }
  return inverse;
}

}  // namespace

JointSpaceInertia::JointSpaceInertia(const RoverParams& params) : masses_(MakeRoverMasses(params)) {
  // MakeRoverMasses promises what FillMass and FillFactor take for granted.
  EXPECT(masses_.rocker.com_B.isZero() && masses_.bogie.com_B.isZero() &&
         masses_.wheel.com_B.isZero());
  EXPECT(masses_.wheel.inertia_kg_m2.x() == masses_.wheel.inertia_kg_m2.z());
  for (std::size_t i = 0; i < 2; ++i) {
    for (const int arm : {kSides[i].rocker, kSides[i].bogie}) {
      joints_[static_cast<std::size_t>(arm)].side = i;
    }
    for (const int joint : kSides[i].wheels) {
      UnitRow& row = joints_[static_cast<std::size_t>(joint)];
      row.side = i;
      row.wheel = static_cast<std::size_t>(joint - kFirstWheel);
      row.of_wheel = 1.0 / std::sqrt(masses_.wheel.inertia_kg_m2.y());
    }
  }
}

void JointSpaceInertia::Update(const Multibody& body) {
  FillMass(body);
  FillFactor(body);
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

// Lets the joints turn freely: wheels first, then the arms. No torque acts about a wheel's axle a,
// so that its spin is
//   s = -a . w - (a . y) (rocker rate + bogie rate),
// w the chassis' rate, y the axis of the arms; the bogie's rate counts where the wheel hangs on it.
// The wheel's moment of inertia I about the axle then drops out of the matrices of the chassis, A,
// of the arms, H, and of their coupling, B. Free arms move at -H^-1 B' v, and the chassis is left
// with S = A - B H^-1 B'. With S = L L' and H = K K' the velocities
//   z = L' v,   K' (arms + H^-1 B' v),   sqrt(I) (spin - s)
// have the mass 1.
void JointSpaceInertia::FillFactor(const Multibody& body) {
  const double spin_kg_m2 = masses_.wheel.inertia_kg_m2.y();
  Matrix6 chassis = mass_.topLeftCorner<6, 6>();
  std::array<Matrix62, 2> by_chassis;       // rates of free arms
  messages::PerWheel<RowVector2d> by_arms;  // spins of free wheels
  for (std::size_t i = 0; i < 2; ++i) {
    const SideJoints& side = kSides[i];
    const int r = 6 + side.rocker;
    const int b = 6 + side.bogie;
    Matrix62 coupling;
    coupling << mass_.block<6, 1>(0, r), mass_.block<6, 1>(0, b);
    Matrix2d arms{{mass_(r, r), mass_(r, b)}, {mass_(b, r), mass_(b, b)}};
    for (const int wheel : side.wheels) {
      const Vector3 axle = Axis_W(body, wheel);
      const double follows = -axle.dot(Axis_W(body, side.rocker));
      RowVector2d& follow = by_arms[static_cast<std::size_t>(wheel - kFirstWheel)];
      follow = {follows, body.Parent(wheel) == side.bogie ? follows : 0.0};
      chassis.topLeftCorner<3, 3>() -= spin_kg_m2 * axle * axle.transpose();
      coupling.topRows<3>() += spin_kg_m2 * axle * follow;
      arms -= spin_kg_m2 * follow.transpose() * follow;
    }
    const Matrix2d K = LowerRoot<2>(arms);
    const Matrix2d inverse = LowerInverse<2>(K);
    arms_[i] = K.transpose();
    // B K^-T, whose square is B H^-1 B'.
    const Matrix62 root = coupling.lazyProduct(inverse.transpose());
    chassis -= root.lazyProduct(root.transpose());
    by_chassis[i] = -root.lazyProduct(inverse);
    joints_[static_cast<std::size_t>(side.rocker)].part.tail<2>() = inverse.col(0);
    joints_[static_cast<std::size_t>(side.bogie)].part.tail<2>() = inverse.col(1);
  }
  const Matrix6 L = LowerRoot<6>(chassis);
  chassis_ = L.transpose();
  chassis_inverse_ = LowerInverse<6>(L);
  for (std::size_t i = 0; i < 2; ++i) {
    const SideJoints& side = kSides[i];
    UnitRow& rocker = joints_[static_cast<std::size_t>(side.rocker)];
    UnitRow& bogie = joints_[static_cast<std::size_t>(side.bogie)];
    rocker.part.head<6>() = chassis_inverse_.lazyProduct(by_chassis[i].col(0));
    bogie.part.head<6>() = chassis_inverse_.lazyProduct(by_chassis[i].col(1));
    for (const int joint : side.wheels) {
      UnitRow& wheel = joints_[static_cast<std::size_t>(joint)];
      const RowVector2d& follow = by_arms[static_cast<std::size_t>(joint - kFirstWheel)];
      wheel.part = follow[0] * rocker.part + follow[1] * bogie.part;
      wheel.part.head<6>() -= chassis_inverse_.leftCols<3>().lazyProduct(Axis_W(body, joint));
    }
  }
}

UnitVelocity JointSpaceInertia::ToUnit(const DofVector& v) const {
  UnitVelocity z;
  z.chassis = chassis_.lazyProduct(v.head<6>());
  for (std::size_t i = 0; i < 2; ++i) {
    Eigen::Vector2d rates;
    for (int k = 0; k < 2; ++k) {
      const int joint = k == 0 ? kSides[i].rocker : kSides[i].bogie;
      rates[k] = v[6 + joint] - OfJoint(joint).part.head<6>().dot(z.chassis);
    }
    z.arms[i] = arms_[i].lazyProduct(rates);
  }
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const int joint = kFirstWheel + static_cast<int>(i);
    const UnitRow& row = OfJoint(joint);
    z.wheels[i] = (v[6 + joint] - row.Velocity(z)) / row.of_wheel;
  }
  return z;
}

DofVector JointSpaceInertia::FromUnit(const UnitVelocity& z) const {
  DofVector v;
  v.head<6>() = chassis_inverse_.transpose().lazyProduct(z.chassis);
  for (int joint = 0; joint < kJoints; ++joint) v[6 + joint] = OfJoint(joint).Velocity(z);
  return v;
}

DofVector JointSpaceInertia::Accelerations(const DofVector& force) const {
  // F F' f.
  UnitVelocity z;
  z.chassis = chassis_inverse_.lazyProduct(force.head<6>());
  for (int joint = 0; joint < kJoints; ++joint) OfJoint(joint).Push(force[6 + joint], z);
  return FromUnit(z);
}

DofMatrix JointSpaceInertia::Inverse() const {
  DofMatrix inverse;
  for (int dof = 0; dof < kDof; ++dof) inverse.col(dof) = Accelerations(DofVector::Unit(dof));
  return inverse;
}

UnitRow JointSpaceInertia::OfPoint(const Multibody& body, int index, const Vector3& p_W,
                                   const Vector3& n_W) const {
  // n . (w x r) = w . (r x n), as in Multibody::FillJacobian.
  Vector6 of_chassis;
  of_chassis << (p_W - body.p_WComChassis()).cross(n_W), n_W;
  UnitRow row;
  row.part.head<6>() = chassis_inverse_.lazyProduct(of_chassis);
  for (int joint = index; joint != kChassis; joint = body.Parent(joint)) {
    const math::Transform& X = body.X_WB(joint);
    const double share = X.linear().col(1).dot((p_W - X.translation()).cross(n_W));
    const UnitRow& turn = OfJoint(joint);
    row.part += share * turn.part;
    row.side = turn.side;
    if (joint < kFirstWheel) continue;
    row.wheel = turn.wheel;
    row.of_wheel = share * turn.of_wheel;
  }
  return row;
}

}  // namespace rockyard::rover
