// The rover's articulated body: chassis, two rockers, two bogies, six wheels. Its dynamics are
// those of Bullet's btMultiBody (Featherstone's articulated-body algorithm), in double precision.
// RockerBogie moves it; both fidelities, parts and links number bodies by the constants below.
// Records depend on Bullet's arithmetic: another version of Bullet may be a change of results.
// Poses and Jacobians are those of the last UpdatePoses, which callers owe after each change.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>

#include "math/pose.h"
#include "rover/rover_params.h"

namespace rockyard::rover {

// The joints, all revolute about the lateral axis. Must stay: parents come before what they carry,
// left before right, rockers, bogies and then wheels. A body has the number of the joint that
// carries it; the chassis is kChassis.
inline constexpr int kChassis = -1;
inline constexpr int kLeftRocker = 0;
inline constexpr int kRightRocker = 1;
inline constexpr int kLeftBogie = 2;
inline constexpr int kRightBogie = 3;
inline constexpr int kFirstWheel = 4;  // wheels in the order of messages::Wheel
inline constexpr int kJoints = 10;
inline constexpr int kDof = 6 + kJoints;

// Generalized velocities, in Bullet's order: the angular velocity of the chassis and the linear
// velocity of its centre of mass, in W, then joint rates, positive about +y (a wheel rolls
// forward).
using DofVector = Eigen::Matrix<double, kDof, 1>;
using DofMatrix = Eigen::Matrix<double, kDof, kDof>;

// The articulated body without contacts and constraints; ConstraintSolver adds those.
class Multibody {
 public:
  explicit Multibody(const RoverParams& params);
  ~Multibody();
  Multibody(const Multibody&) = delete;
  Multibody& operator=(const Multibody&) = delete;

  // Sets the pose, and all joint angles and velocities to zero.
  void Reset(const math::Transform& X_WR);
  void StopMotion();
  // Turns the axle of a wheel about the z axis of its carrier through the wheel's centre, at once
  // and without torque.
  void SetSteer(std::size_t wheel, double angle_rad);

  // Brings what the queries below return up to date with the joint angles and the chassis pose.
  void UpdatePoses();
  const math::Transform& X_WR() const { return X_WR_; }
  // Returns the frame of a body, with indices from kChassis: origin at its joint (chassis: X_WR),
  // axes parallel to R when its joint is at zero.
  const math::Transform& X_WB(int body) const {
    return body == kChassis ? X_WR_ : X_WB_[static_cast<std::size_t>(body)];
  }
  int Parent(int body) const { return parent_[static_cast<std::size_t>(body)]; }
  double JointAngle(int joint) const;
  DofVector Velocity() const;
  math::Vector3 p_WComChassis() const { return p_WCom_; }

  // Adds to the velocities what gravity and inertial forces do in one step without contacts.
  void Accelerate(double gravity_m_s2, double step_s);
  void AddVelocity(const DofVector& change);
  // Moves the positions by one step.
  void Move(double step_s);

  // Fills a row of the Jacobian: J with v = J velocities for the velocity v, along the unit vector
  // n, of the point p fixed to a body.
  void FillJacobian(int body, const math::Vector3& p_W, const math::Vector3& n_W,
                    DofVector& row) const;

 private:
  struct Bullet;
  void BuildLinks(const RoverParams& params);

  std::unique_ptr<Bullet> bullet_;
  bool moved_ = true;     // since the last UpdatePoses
  math::Vector3 p_RCom_;  // of the chassis
  math::Vector3 p_WCom_ = math::Vector3::Zero();
  math::Transform X_WR_ = math::Transform::Identity();
  std::array<math::Transform, kJoints> X_WB_{};
  std::array<int, kJoints> parent_{};
};

}  // namespace rockyard::rover
