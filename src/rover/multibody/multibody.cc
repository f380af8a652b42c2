#include "rover/multibody/multibody.h"

#include "math/functions.h"

namespace rockyard::rover {

using math::Vector3;

Multibody::Multibody(const RoverParams& params) : masses_(MakeRoverMasses(params)) {
  const RoverGeometry geometry = MakeRoverGeometry(params.geometry);
  std::array<Vector3, kJoints> pivot_R;
  // With all joints at zero every frame is parallel to R.
  const auto add = [&](int joint, int parent, const Vector3& p_R) {
    const auto i = static_cast<std::size_t>(joint);
    pivot_R[i] = p_R;
    links_[i] = {parent, parent == kChassis
                             ? p_R
                             : Vector3(p_R - pivot_R[static_cast<std::size_t>(parent)])};
    X_WB_[i].setIdentity();
  };
  for (int side = 0; side < 2; ++side) {
    add(kLeftRocker + side, kChassis, geometry.rocker_pivot_R[static_cast<std::size_t>(side)]);
  }
  for (int side = 0; side < 2; ++side) {
    add(kLeftBogie + side, kLeftRocker + side,
        geometry.bogie_pivot_R[static_cast<std::size_t>(side)]);
  }
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const int side = i < 3 ? 0 : 1;
    add(kFirstWheel + static_cast<int>(i), (geometry.on_bogie[i] ? kLeftBogie : kLeftRocker) + side,
        geometry.wheel_R[i]);
    SetSteer(i, 0.0);
  }
  Reset(math::Transform::Identity());
}

void Multibody::Reset(const math::Transform& X_WR) {
  q_WR_ = Eigen::Quaterniond(X_WR.linear());
  p_WCom_ = X_WR * masses_.chassis.com_B;
  angle_rad_.fill(0.0);
  StopMotion();
  moved_ = true;
  UpdatePoses();
}

void Multibody::SetSteer(std::size_t wheel, double angle_rad) {
  steer_[wheel] = {math::Cos(angle_rad), math::Sin(angle_rad)};
  moved_ = true;
}

void Multibody::UpdatePoses() {
  if (!moved_) return;
  moved_ = false;
  X_WR_.linear() = q_WR_.toRotationMatrix();
  X_WR_.translation() = p_WCom_ - X_WR_.linear() * masses_.chassis.com_B;
  for (int joint = 0; joint < kJoints; ++joint) {
    const auto i = static_cast<std::size_t>(joint);
    const math::Transform& X = X_WB(links_[i].parent);
    X_WB_[i].translation() = X.linear() * links_[i].from_parent + X.translation();
    const Vector3 x = X.linear().col(0);
    const Vector3 y = X.linear().col(1);
    const Vector3 z = X.linear().col(2);
    if (joint < kFirstWheel) {
      // R_WB = R_WP Ry(angle).
      const auto [s, c] = math::SinCos(angle_rad_[i]);
      X_WB_[i].linear() << c * x - s * z, y, s * x + c * z;
    } else {
      // R_WB = R_WP Rz(steer).
      const auto [c, s] = steer_[i - kFirstWheel];
      X_WB_[i].linear() << c * x + s * y, c * y - s * x, z;
    }
  }
}

// Recursive Newton and Euler (Featherstone 2008 ch. 5) with all accelerations of the generalized
// velocities zero: what is left are the bodies' accelerations a and alpha by their velocities, and
// f = J' (m (g - a), -(I alpha + w x I w)), summed from the leaves down.
DofVector Multibody::FreeForce(double gravity_m_s2) const {
  struct Motion {
    Vector3 w, alpha, a;
  };
  struct Load {
    Vector3 force, torque;
  };
  std::array<Motion, kJoints> motions;
  std::array<Load, kJoints> loads;
  std::array<Vector3, kJoints> from_parent;
  const Vector3 g(0.0, 0.0, -gravity_m_s2);
  const Motion chassis{velocity_.head<3>(), Vector3::Zero(), Vector3::Zero()};
  Load sum{masses_.chassis.mass_kg * g,
           -Torque(masses_.chassis, X_WR_.linear(), chassis.w, chassis.alpha)};
  for (int joint = 0; joint < kJoints; ++joint) {
    const auto i = static_cast<std::size_t>(joint);
    const int parent = links_[i].parent;
    const Motion& p = parent == kChassis ? chassis : motions[static_cast<std::size_t>(parent)];
    const math::Transform& X = X_WB_[i];
    const Vector3 r = X.translation() - (parent == kChassis ? p_WCom_ : X_WB(parent).translation());
    const Vector3 turn = velocity_[6 + joint] * X.linear().col(1);
    motions[i] = {p.w + turn, p.alpha + p.w.cross(turn),
                  p.a + p.alpha.cross(r) + p.w.cross(p.w.cross(r))};
    from_parent[i] = r;
    const BodyMass& mass = MassOf(joint);
    loads[i] = {mass.mass_kg * (g - motions[i].a),
                -Torque(mass, X.linear(), motions[i].w, motions[i].alpha)};
  }
  DofVector f;
  for (int joint = kJoints - 1; joint >= 0; --joint) {
    const auto i = static_cast<std::size_t>(joint);
    const int parent = links_[i].parent;
    f[6 + joint] = X_WB_[i].linear().col(1).dot(loads[i].torque);
    Load& onto = parent == kChassis ? sum : loads[static_cast<std::size_t>(parent)];
    onto.force += loads[i].force;
    onto.torque += loads[i].torque + from_parent[i].cross(loads[i].force);
  }
  f.head<3>() = sum.torque;
  f.segment<3>(3) = sum.force;
  return f;
}

Vector3 Multibody::Torque(const BodyMass& mass, const Eigen::Matrix3d& R_WB, const Vector3& w,
                          const Vector3& alpha) {
  const Vector3 w_B = R_WB.transpose() * w;
  const Vector3 alpha_B = R_WB.transpose() * alpha;
  return R_WB * (mass.inertia_kg_m2.cwiseProduct(alpha_B) +
                 w_B.cross(mass.inertia_kg_m2.cwiseProduct(w_B)));
}

// Semi-implicit Euler: positions move with the velocities of the end of the step, the attitude by
// the rotation h w.
void Multibody::Move(double step_s) {
  p_WCom_ += step_s * velocity_.segment<3>(3);
  const Vector3 w = velocity_.head<3>();
  const double speed_rad_s = w.norm();
  // A turn too small to be told from 2 sin(turn / 2).
  constexpr double kSmall_rad = 1e-8;
  const double half_rad = 0.5 * step_s * speed_rad_s;
  const double share = half_rad < kSmall_rad ? 0.5 * step_s : math::Sin(half_rad) / speed_rad_s;
  const Vector3 turn = share * w;
  q_WR_ = Eigen::Quaterniond(math::Cos(half_rad), turn.x(), turn.y(), turn.z()) * q_WR_;
  q_WR_.normalize();
  for (int joint = 0; joint < kJoints; ++joint) {
    angle_rad_[static_cast<std::size_t>(joint)] += step_s * velocity_[6 + joint];
  }
  moved_ = true;
}

void Multibody::FillJacobian(int body, const Vector3& p_W, const Vector3& n_W,
                             DofVector& row) const {
  row.setZero();
  // n . v for v = v_com + w x r + sum of joints rate y_B x (p - o_B): n . (w x r) = w . (r x n),
  // and likewise for each joint from the body up to the chassis.
  row.head<3>() = (p_W - p_WCom_).cross(n_W);
  row.segment<3>(3) = n_W;
  for (int joint = body; joint != kChassis; joint = Parent(joint)) {
    const math::Transform& X = X_WB(joint);
    row[6 + joint] = X.linear().col(1).dot((p_W - X.translation()).cross(n_W));
  }
}

}  // namespace rockyard::rover
