// The joint-space mass matrix M of the articulated body, and velocities in which it is 1, by which
// RockerBogie lets the constraint solver turn impulses into velocities. Records depend on the bits
// of both.
#pragma once

#include <Eigen/Core>
#include <array>

#include "rover/multibody/multibody.h"
#include "rover/rover_layout_params.h"
#include "rover/rover_params.h"

namespace rockyard::rover {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector8 = Eigen::Matrix<double, 8, 1>;

// Velocities z with kinetic energy |z|^2 / 2: of the chassis, of rocker and bogie of each side
// against what they would do if they were free, and of each wheel likewise.
struct UnitVelocity {
  Vector6 chassis = Vector6::Zero();
  std::array<Eigen::Vector2d, 2> arms{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  messages::PerWheel<double> wheels{};

  // Returns what the rows of one side see, wheels left out.
  Vector8 Of(std::size_t side) const {
    Vector8 part;
    part << chassis, arms[side];
    return part;
  }
  void Set(std::size_t side, const Vector8& part) {
    chassis = part.head<6>();
    arms[side] = part.tail<2>();
  }
};

// A row j of a Jacobian with velocity = j . z. As the mass is 1 it is also the change of z by a
// unit impulse. It sees chassis and arms of one side, and one wheel.
struct UnitRow {
  Vector8 part = Vector8::Zero();
  double of_wheel = 0.0;
  std::size_t side = 0;
  std::size_t wheel = 0;

  double Velocity(const UnitVelocity& z) const {
    return part.head<6>().dot(z.chassis) + part.tail<2>().dot(z.arms[side]) +
           of_wheel * z.wheels[wheel];
  }
  void Push(double impulse, UnitVelocity& z) const {
    z.chassis += impulse * part.head<6>();
    z.arms[side] += impulse * part.tail<2>();
    z.wheels[wheel] += impulse * of_wheel;
  }
  // Returns the change of the row's velocity by a unit impulse.
  double Yield() const { return part.squaredNorm() + of_wheel * of_wheel; }
};

// M, and F with v = F z and M^-1 = F F', for generalized velocities v in the order of DofVector:
// kinetic energy is 1/2 v' M v, and a generalized force f accelerates the free body by M^-1 f. M
// comes from composite rigid bodies (Featherstone 2008 ch. 6). F eliminates joints from the leaves
// down to the chassis, as a joint couples only with its ancestors and descendants (Featherstone
// 2005, Int. J. Robotics Research 24(6)).
class JointSpaceInertia {
 public:
  explicit JointSpaceInertia(const RoverParams& params);

  // Computes both for the poses that `body` had at its last UpdatePoses; about 0.5 us.
  void Update(const Multibody& body);

  const DofMatrix& mass() const { return mass_; }
  // Returns M^-1, for checks: the solver needs F only.
  DofMatrix Inverse() const;

  UnitVelocity ToUnit(const DofVector& v) const;
  DofVector FromUnit(const UnitVelocity& z) const;
  // Returns M^-1 f.
  DofVector Accelerations(const DofVector& force) const;
  // Returns the row of a joint's rate.
  const UnitRow& OfJoint(int joint) const { return joints_[static_cast<std::size_t>(joint)]; }
  // Returns the row of the velocity, along the unit vector n, of the point p fixed to a body, of
  // which UnitRow's velocity is that of Multibody::FillJacobian. `body` is that of the last Update.
  UnitRow OfPoint(const Multibody& body, int index, const math::Vector3& p_W,
                  const math::Vector3& n_W) const;

 private:
  void FillMass(const Multibody& body);
  void FillFactor(const Multibody& body);

  const RoverMasses masses_;
  DofMatrix mass_ = DofMatrix::Zero();
  Matrix6 chassis_ = Matrix6::Zero();          // L' of the free chassis' matrix S = L L'
  Matrix6 chassis_inverse_ = Matrix6::Zero();  // L^-1
  std::array<Eigen::Matrix2d, 2> arms_{};      // L' of the free arms' matrices
  std::array<UnitRow, kJoints> joints_{};
};

}  // namespace rockyard::rover
