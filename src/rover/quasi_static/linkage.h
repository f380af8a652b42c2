// Rocker-bogie linkage of the quasi-static rover: nine coordinates, poses of its bodies, velocities
// of its points, and what gravity does. Contacts are found on it, and the balance of forces is
// solved in its rates. Its weights must agree with MakeRoverMasses (rover_layout_params.h), by
// which the multibody moves.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "math/pose.h"
#include "messages/wheels.h"
#include "rover/multibody/multibody.h"
#include "rover/rover_params.h"

namespace rockyard::rover {

// The nine rates: the velocity of R's origin in W (m/s), the angular velocity of the chassis in W
// (rad/s), the rate of the left rocker (the differential turns the right one back by as much), the
// rates of left and right bogie (rad/s). Generalized forces are in the same order, N and N m.
inline constexpr int kLinkageDof = 9;
inline constexpr int kRockerDof = 6;
inline constexpr int kFirstBogieDof = 7;  // by Side
using LinkageVector = Eigen::Matrix<double, kLinkageDof, 1>;

// The eight rates that move the points of one side: the six of the chassis, the rocker, the bogie.
using SideVector = Eigen::Matrix<double, 8, 1>;
// Four vectors of such, as columns.
using SideVectors = Eigen::Matrix<double, 8, 4>;

// How a point of a body moves with the rates of its side, all in W.
struct PointMotion {
  math::Vector3 lever_W;   // from R's origin
  math::Vector3 rocker_W;  // velocity by the rocker's rate
  math::Vector3 bogie_W;   // velocity by the bogie's rate

  // Returns the row with row . rates = d . v.
  SideVector Along(const math::Vector3& d_W) const {
    SideVector row;
    row << d_W, lever_W.cross(d_W), rocker_W.dot(d_W), bogie_W.dot(d_W);
    return row;
  }
};

// Where the linkage is, by its nine coordinates.
struct Posture {
  math::Vector3 p_WR = math::Vector3::Zero();
  Eigen::Quaterniond q_WR = Eigen::Quaterniond::Identity();
  double rocker_rad = 0.0;  // left; right is the negative
  std::array<double, 2> bogie_rad{};
};

// Returns the posture after `time_s` at constant rates.
Posture Moved(const Posture& posture, const LinkageVector& rates, double time_s);

// Returns the posture at `share` in [0, 1] of the way: linear, the attitude along the shorter arc.
Posture Between(const Posture& from, const Posture& to, double share);

// The linkage in one posture.
class Linkage {
 public:
  // The frame of a body: origin at its joint, axes parallel to R when its joint is at zero.
  struct Frame {
    Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();
    math::Vector3 p_WB = math::Vector3::Zero();
  };

  explicit Linkage(const RoverParams& params);

  // Takes steering angles; the next Update turns the axles by them.
  void Steer(const messages::PerWheel<double>& steer_rad);
  // Returns cosine and sine of a wheel's steering angle.
  const Eigen::Vector2d& steer(std::size_t wheel) const { return steer_[wheel]; }
  // Takes a posture and steering angles, and turns the axles by the angles.
  void Update(const Posture& posture, const messages::PerWheel<double>& steer_rad);

  const Frame& chassis() const { return chassis_; }
  const Frame& body(int index) const {  // numbered as in multibody.h, wheels without their spin
    return index == kChassis ? chassis_ : bodies_[static_cast<std::size_t>(index)];
  }
  const math::Vector3& wheel_W(std::size_t wheel) const {
    return bodies_[static_cast<std::size_t>(kFirstWheel) + wheel].p_WB;
  }
  math::Vector3 axle_W(std::size_t wheel) const {
    return bodies_[static_cast<std::size_t>(kFirstWheel) + wheel].R_WB.col(1);
  }

  // Returns the side of a body, 0 left, 1 right; 0 for the chassis.
  static std::size_t SideOf(int body);
  // Returns how a point moves that is fixed to a body; wheels do not spin.
  PointMotion MotionOf(int body, const math::Vector3& p_W) const;

  // Returns the generalized force of gravity, N and N m.
  LinkageVector Gravity() const;
  double weight_N() const { return weight_N_; }

 private:
  struct Lump {  // weight fixed to a body
    int body = kChassis;
    math::Vector3 p_B = math::Vector3::Zero();
    double weight_N = 0.0;
  };

  bool OnBogie(int body) const;

  std::array<math::Vector3, 2> rocker_pivot_R_;
  std::array<math::Vector3, 2> bogie_from_rocker_;
  messages::PerWheel<math::Vector3> wheel_from_pivot_;
  messages::PerWheel<bool> on_bogie_{};
  std::array<Lump, 5> lumps_;
  double weight_N_;
  messages::PerWheel<double> steer_rad_{};
  messages::PerWheel<Eigen::Vector2d> steer_;  // cosine and sine
  Frame chassis_;
  std::array<Frame, kJoints> bodies_;
};

// The 9 x 9 system of one step of Newton's method: the force on the linkage and minus its
// derivative by the rates, summed from terms that act in the space of one side's rates.
class LinkageEquations {
 public:
  // Begins with a force, and with a diagonal as minus the force's derivative.
  void Reset(const LinkageVector& force, const LinkageVector& diagonal);

  // Adds a force that acts on one side's rates.
  void AddForce(std::size_t side, const SideVector& f);
  // Adds P A', a symmetric sum.
  void AddStiffness(std::size_t side, const SideVectors& P, const SideVectors& A);
  // Adds a force and its stiffness to one coordinate.
  void AddAt(int dof, double force, double stiffness);

  const LinkageVector& force() const { return force_; }
  // Returns the change of the rates with which the linearized force vanishes. A call costs about
  // 0.1 us.
  LinkageVector Solve() const;

 private:
  using SideMatrix = Eigen::Matrix<double, 8, 8>;  // its lower triangle

  LinkageVector force_;
  LinkageVector diagonal_;
  std::array<SideMatrix, 2> side_stiffness_;
};

}  // namespace rockyard::rover
