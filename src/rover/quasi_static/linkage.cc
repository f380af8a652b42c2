#include "rover/quasi_static/linkage.h"

#include <cmath>

#include "rover/rover_layout_params.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

// Returns the sign of a rocker's angle: by the differential the right rocker turns back by what the
// left one turns.
double RockerSign(std::size_t side) { return side == 0 ? 1.0 : -1.0; }

// Returns R Ry(a): the axes of a frame, turned about its own y axis. Positive angles lower the
// front.
Eigen::Matrix3d Pitched(const Eigen::Matrix3d& R, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  Eigen::Matrix3d result;
  result.col(0) = c * R.col(0) - s * R.col(2);
  result.col(1) = R.col(1);
  result.col(2) = s * R.col(0) + c * R.col(2);
  return result;
}

constexpr int kShared = 7;  // the coordinates that both sides have

}  // namespace

Posture Moved(const Posture& posture, const LinkageVector& rates, double time_s) {
  Posture next = posture;
  next.p_WR += time_s * rates.head<3>();
  // q(t) = exp(t w / 2) q with w in W, to first order (1, t w / 2). Steps turn by a few degrees:
  // tan(x) = x to 1e-5 of the turn, and the norm is restored.
  const Vector3 half = 0.5 * time_s * rates.segment<3>(3);
  next.q_WR = (Eigen::Quaterniond(1.0, half.x(), half.y(), half.z()) * posture.q_WR).normalized();
  next.rocker_rad += time_s * rates[kRockerDof];
  for (std::size_t side = 0; side < 2; ++side) {
    next.bogie_rad[side] += time_s * rates[kFirstBogieDof + static_cast<int>(side)];
  }
  return next;
}

Posture Between(const Posture& from, const Posture& to, double share) {
  Posture result;
  result.p_WR = from.p_WR + share * (to.p_WR - from.p_WR);
  // q and -q are the same attitude; the nearer of the two gives the shorter arc.
  const double sign = from.q_WR.dot(to.q_WR) < 0.0 ? -1.0 : 1.0;
  result.q_WR.coeffs() =
      ((1.0 - share) * from.q_WR.coeffs() + sign * share * to.q_WR.coeffs()).normalized();
  result.rocker_rad = from.rocker_rad + share * (to.rocker_rad - from.rocker_rad);
  for (std::size_t side = 0; side < 2; ++side) {
    result.bogie_rad[side] =
        from.bogie_rad[side] + share * (to.bogie_rad[side] - from.bogie_rad[side]);
  }
  return result;
}

Linkage::Linkage(const RoverParams& params) {
  steer_.fill(Eigen::Vector2d::UnitX());
  const RoverGeometry geometry = MakeRoverGeometry(params.geometry);
  const RoverMassParams& mass = params.mass;
  const double g = params.physics.gravity_m_s2;
  rocker_pivot_R_ = geometry.rocker_pivot_R;
  on_bogie_ = geometry.on_bogie;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const std::size_t side = i / 3;
    wheel_from_pivot_[i] = geometry.wheel_R[i] - (on_bogie_[i] ? geometry.bogie_pivot_R[side]
                                                               : geometry.rocker_pivot_R[side]);
  }
  // Rockers weigh on their pivots, which the chassis carries; a bogie and its wheels are one lump.
  // The masses must be those of MakeRoverMasses (rover_layout_params.cc), so that both fidelities
  // have the same wheel loads.
  const double chassis_kg =
      mass.total_kg - 6.0 * mass.wheel_kg - 2.0 * (mass.rocker_kg + mass.bogie_kg);
  // Chassis and rockers as one lump, at their common centre of mass.
  const double carried_kg = chassis_kg + 2.0 * mass.rocker_kg;
  const Vector3 com_R(mass.chassis_com_x_m, 0.0, mass.chassis_com_z_m);
  lumps_[0] = {kChassis,
               (chassis_kg * com_R +
                mass.rocker_kg * (geometry.rocker_pivot_R[0] + geometry.rocker_pivot_R[1])) /
                   carried_kg,
               carried_kg * g};
  for (std::size_t side = 0; side < 2; ++side) {
    bogie_from_rocker_[side] = geometry.bogie_pivot_R[side] - geometry.rocker_pivot_R[side];
    Vector3 bogie = Vector3::Zero();
    Vector3 rocker = Vector3::Zero();
    int bogie_wheels = 0;
    for (std::size_t i = 3 * side; i < 3 * side + 3; ++i) {
      (on_bogie_[i] ? bogie : rocker) += mass.wheel_kg * wheel_from_pivot_[i];
      bogie_wheels += on_bogie_[i] ? 1 : 0;
    }
    // Centre of mass of a lump: sum m_i p_i / sum m_i, in the frame of the body. Bogie and rocker
    // themselves weigh on their pivots, at the origin of that frame, and add nothing to the sum.
    const double bogie_kg = mass.bogie_kg + bogie_wheels * mass.wheel_kg;
    const double rocker_kg = (3 - bogie_wheels) * mass.wheel_kg;
    const int index = static_cast<int>(side);
    lumps_[1 + 2 * side] = {kLeftBogie + index, bogie / bogie_kg, bogie_kg * g};
    lumps_[2 + 2 * side] = {kLeftRocker + index, rocker / rocker_kg, rocker_kg * g};
  }
  weight_N_ = mass.total_kg * g;
  Update({}, {});
}

void Linkage::Steer(const messages::PerWheel<double>& steer_rad) {
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    if (steer_rad[i] == steer_rad_[i]) continue;
    steer_rad_[i] = steer_rad[i];
    steer_[i] = Eigen::Vector2d(std::cos(steer_rad[i]), std::sin(steer_rad[i]));
  }
}

void Linkage::Update(const Posture& posture, const messages::PerWheel<double>& steer_rad) {
  Steer(steer_rad);
  chassis_ = {posture.q_WR.toRotationMatrix(), posture.p_WR};
  for (std::size_t side = 0; side < 2; ++side) {
    const double rocker_rad = RockerSign(side) * posture.rocker_rad;
    Frame& rocker = bodies_[kLeftRocker + side];
    Frame& bogie = bodies_[kLeftBogie + side];
    // Forward kinematics: chassis, rocker pivot, bogie pivot, wheel centre. Bogie angles are
    // against the rocker.
    rocker = {Pitched(chassis_.R_WB, rocker_rad),
              chassis_.p_WB + chassis_.R_WB * rocker_pivot_R_[side]};
    bogie = {Pitched(chassis_.R_WB, rocker_rad + posture.bogie_rad[side]),
             rocker.p_WB + rocker.R_WB * bogie_from_rocker_[side]};
    for (std::size_t i = 3 * side; i < 3 * side + 3; ++i) {
      const Frame& carrier = on_bogie_[i] ? bogie : rocker;
      Frame& wheel = bodies_[kFirstWheel + i];
      wheel.p_WB = carrier.p_WB + carrier.R_WB * wheel_from_pivot_[i];
      // Steering turns the axle about the carrier's z axis: R_WB = R_carrier Rz(delta).
      wheel.R_WB.col(0) = steer_[i].x() * carrier.R_WB.col(0) + steer_[i].y() * carrier.R_WB.col(1);
      wheel.R_WB.col(1) = steer_[i].x() * carrier.R_WB.col(1) - steer_[i].y() * carrier.R_WB.col(0);
      wheel.R_WB.col(2) = carrier.R_WB.col(2);
    }
  }
}

std::size_t Linkage::SideOf(int body) {
  if (body == kChassis) return 0;
  // Rockers and bogies are numbered left, right, left, right.
  if (body < kFirstWheel) return static_cast<std::size_t>(body % 2);
  return body < kFirstWheel + 3 ? 0 : 1;
}

bool Linkage::OnBogie(int body) const {
  return body == kLeftBogie || body == kRightBogie ||
         (body >= kFirstWheel && on_bogie_[static_cast<std::size_t>(body - kFirstWheel)]);
}

PointJacobian Linkage::Jacobian(int body, const Vector3& p_W) const {
  // v = v_R + w x r + rates of rocker and bogie times y x (lever from that pivot), all in W. All
  // pivots are about the chassis' y axis, whatever their angles.
  const Vector3 r = p_W - chassis_.p_WB;
  PointJacobian J;
  J << 1, 0, 0, 0, r.z(), -r.y(), 0, 0,  //
      0, 1, 0, -r.z(), 0, r.x(), 0, 0,   //
      0, 0, 1, r.y(), -r.x(), 0, 0, 0;
  if (body == kChassis) return J;
  const std::size_t side = SideOf(body);
  const Vector3 y_W = chassis_.R_WB.col(1);
  J.col(6) = RockerSign(side) * y_W.cross(p_W - bodies_[kLeftRocker + side].p_WB);
  if (OnBogie(body)) J.col(7) = y_W.cross(p_W - bodies_[kLeftBogie + side].p_WB);
  return J;
}

LinkageVector Linkage::Gravity() const {
  LinkageVector force = LinkageVector::Zero();
  for (const Lump& lump : lumps_) {
    const Frame& frame = body(lump.body);
    // Principle of virtual work: Q = J' (0, 0, -weight), that is minus the weight times the row of
    // v_z.
    const SideVector f =
        -lump.weight_N * Jacobian(lump.body, frame.p_WB + frame.R_WB * lump.p_B).row(2).transpose();
    force.head<7>() += f.head<7>();
    force[kFirstBogieDof + static_cast<int>(SideOf(lump.body))] += f[7];
  }
  return force;
}

void LinkageEquations::Reset(const LinkageVector& force, const LinkageVector& diagonal) {
  force_ = force;
  diagonal_ = diagonal;
  for (SideMatrix& stiffness : side_stiffness_) stiffness.setZero();
}

void LinkageEquations::AddForce(std::size_t side, const SideVector& f) {
  force_.head<kShared>() += f.head<kShared>();
  force_[kFirstBogieDof + static_cast<int>(side)] += f[kShared];
}

void LinkageEquations::AddStiffness(std::size_t side, double k, const SideVector& a) {
  side_stiffness_[side] += (k * a).lazyProduct(a.transpose());
}

void LinkageEquations::AddStiffness(std::size_t side, const SideVector& p, const SideVector& a,
                                    const SideVector& q, const SideVector& b, const SideVector& r,
                                    const SideVector& c) {
  // Whole columns are summed, not the lower triangle alone: the processor takes several rows at a
  // time.
  SideMatrix& stiffness = side_stiffness_[side];
  for (int j = 0; j < stiffness.cols(); ++j) stiffness.col(j) += a[j] * p + b[j] * q + c[j] * r;
}

void LinkageEquations::AddAt(int dof, double force, double stiffness) {
  force_[dof] += force;
  diagonal_[dof] += stiffness;
}

// Returns the system with the force as the last entry of each row. Row 7 of a side is its bogie,
// which is row 7 (left) or 8 (right) of the system. The two bogies share no term, so that entry
// (8, 7) is zero.
LinkageEquations::Rows LinkageEquations::Augmented() const {
  const auto& [left, right] = side_stiffness_;
  constexpr int kLeft = kFirstBogieDof;
  constexpr int kRight = kFirstBogieDof + 1;
  Rows rows;
  for (int i = 0; i < kShared; ++i) {
    rows[i].head<kShared>() = left.col(i).head<kShared>() + right.col(i).head<kShared>();
    rows[i].tail<3>() << left(kShared, i), right(kShared, i), force_[i];
  }
  rows[kLeft].head<kShared>() = left.col(kShared).head<kShared>();
  rows[kLeft].tail<3>() << left(kShared, kShared), 0.0, force_[kLeft];
  rows[kRight].head<kShared>() = right.col(kShared).head<kShared>();
  rows[kRight].tail<3>() << 0.0, right(kShared, kShared), force_[kRight];
  for (int i = 0; i < kLinkageDof; ++i) rows[i][i] += diagonal_[i];
  return rows;
}

// Gauss's elimination, which needs no pivots as the matrix is positive definite. Whole rows are
// subtracted, zeros as well: loops of one length are faster than half the work in loops of many.
LinkageVector LinkageEquations::Solve() const {
  Rows rows = Augmented();
  LinkageVector inverse;
  for (int j = 0; j < kLinkageDof; ++j) {
    inverse[j] = 1.0 / rows[j][j];
    for (int i = j + 1; i < kLinkageDof; ++i) rows[i] -= rows[i][j] * inverse[j] * rows[j];
  }
  // From the last row up: x_j = (f_j - sum over k > j of U_jk x_k) / U_jj.
  LinkageVector x;
  for (int j = kLinkageDof - 1; j >= 0; --j) {
    double rest = rows[j][kLinkageDof];
    for (int k = j + 1; k < kLinkageDof; ++k) rest -= rows[j][k] * x[k];
    x[j] = rest * inverse[j];
  }
  return x;
}

}  // namespace rockyard::rover
