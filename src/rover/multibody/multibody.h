// The rover's articulated body: chassis, two rockers, two bogies, six wheels; where they are, how
// they move, and the forces of gravity and of their motion. RockerBogie moves it; both fidelities,
// parts and links number bodies by the constants below. Poses, Jacobians and forces are those of
// the last UpdatePoses, which callers owe after each change. The tests hold it against Bullet
// (bullet_rover.h). Records depend on the bits of all of it.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "math/pose.h"
#include "messages/wheels.h"
#include "rover/rover_layout_params.h"
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

// Generalized velocities, in the order of Bullet: the angular velocity of the chassis and the
// linear velocity of its centre of mass, in W, then joint rates, positive about +y (a wheel rolls
// forward).
using DofVector = Eigen::Matrix<double, kDof, 1>;
using DofMatrix = Eigen::Matrix<double, kDof, kDof>;

// The articulated body without contacts and constraints; ConstraintSolver adds those.
class Multibody {
 public:
  explicit Multibody(const RoverParams& params);

  // Sets the pose, and all joint angles and velocities to zero.
  void Reset(const math::Transform& X_WR);
  void StopMotion() { velocity_.setZero(); }
  // Turns the axle of a wheel about the z axis of its carrier through the wheel's centre, at once
  // and without torque.
  void SetSteer(std::size_t wheel, double angle_rad);

  // Brings what the queries below return up to date with the joint angles and the chassis pose.
  void UpdatePoses();
  const math::Transform& X_WR() const { return X_WR_; }
  // Returns the frame of a body, with indices from kChassis: origin at its joint (chassis: X_WR),
  // axes parallel to R when its joint is at zero. Frames of wheels turn with their steering but do
  // not spin.
  const math::Transform& X_WB(int body) const {
    return body == kChassis ? X_WR_ : X_WB_[static_cast<std::size_t>(body)];
  }
  int Parent(int body) const { return links_[static_cast<std::size_t>(body)].parent; }
  double JointAngle(int joint) const { return angle_rad_[static_cast<std::size_t>(joint)]; }
  const DofVector& Velocity() const { return velocity_; }
  math::Vector3 p_WComChassis() const { return p_WCom_; }

  // Returns the generalized force f of gravity and motion: the free body accelerates by M^-1 f.
  DofVector FreeForce(double gravity_m_s2) const;
  void AddVelocity(const DofVector& change) { velocity_ += change; }
  // Moves the positions by one step.
  void Move(double step_s);

  // Fills a row of the Jacobian: J with v = J velocities for the velocity v, along the unit vector
  // n, of the point p fixed to a body.
  void FillJacobian(int body, const math::Vector3& p_W, const math::Vector3& n_W,
                    DofVector& row) const;

 private:
  // A body as its joint carries it: from the origin of its parent's frame, in that frame.
  struct Link {
    int parent = kChassis;
    math::Vector3 from_parent = math::Vector3::Zero();
  };
  const BodyMass& MassOf(int joint) const {
    return joint <= kRightRocker ? masses_.rocker
           : joint < kFirstWheel ? masses_.bogie
                                 : masses_.wheel;
  }
  // Returns what the body's motion with the angular velocity w and the angular acceleration alpha
  // asks for, as a torque about its centre of mass: I alpha + w x I w.
  static math::Vector3 Torque(const BodyMass& mass, const Eigen::Matrix3d& R_WB,
                              const math::Vector3& w, const math::Vector3& alpha);

  const RoverMasses masses_;
  std::array<Link, kJoints> links_{};
  Eigen::Quaterniond q_WR_ = Eigen::Quaterniond::Identity();
  math::Vector3 p_WCom_ = math::Vector3::Zero();
  std::array<double, kJoints> angle_rad_{};
  messages::PerWheel<std::array<double, 2>> steer_{};  // cosine and sine
  DofVector velocity_ = DofVector::Zero();
  bool moved_ = true;  // since the last UpdatePoses
  math::Transform X_WR_ = math::Transform::Identity();
  std::array<math::Transform, kJoints> X_WB_{};
};

}  // namespace rockyard::rover
