#include "rover/quasi_static/linkage.h"

#include <cmath>
#include <utility>

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
  const auto [s, c] = math::SinCos(angle_rad);
  Eigen::Matrix3d result;
  result.col(0) = c * R.col(0) - s * R.col(2);
  result.col(1) = R.col(1);
  result.col(2) = s * R.col(0) + c * R.col(2);
  return result;
}

constexpr int kShared = 7;  // the coordinates that both sides have

// Calls visit<0>() to visit<count - 1>(): loops over columns of the lower triangle, unrolled.
template <int count, typename Visitor>
void ForEach(Visitor&& visit) {
  [&]<int... index>(std::integer_sequence<int, index...>) {
    (visit.template operator()<index>(), ...);
  }
  (std::make_integer_sequence<int, count>());
}

// Rows of a column of the lower triangle of an 8 x 8 matrix, in whole pairs: the processor takes
// two at a time.
constexpr int Rows(int column) { return 8 - (column & ~1); }

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
    steer_[i] = Eigen::Vector2d(math::Cos(steer_rad[i]), math::Sin(steer_rad[i]));
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

PointMotion Linkage::MotionOf(int body, const Vector3& p_W) const {
  // v = v_R + w x r + rates of rocker and bogie times y x (lever from that pivot), all in W. All
  // pivots are about the chassis' y axis, whatever their angles.
  PointMotion motion{p_W - chassis_.p_WB, Vector3::Zero(), Vector3::Zero()};
  if (body == kChassis) return motion;
  const std::size_t side = SideOf(body);
  const Vector3 y_W = chassis_.R_WB.col(1);
  motion.rocker_W = RockerSign(side) * y_W.cross(p_W - bodies_[kLeftRocker + side].p_WB);
  if (OnBogie(body)) motion.bogie_W = y_W.cross(p_W - bodies_[kLeftBogie + side].p_WB);
  return motion;
}

LinkageVector Linkage::Gravity() const {
  LinkageVector force = LinkageVector::Zero();
  for (const Lump& lump : lumps_) {
    const Frame& frame = body(lump.body);
    // Principle of virtual work: the weight does work along v_z.
    const SideVector f =
        MotionOf(lump.body, frame.p_WB + frame.R_WB * lump.p_B).Along({0.0, 0.0, -lump.weight_N});
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

void LinkageEquations::AddStiffness(std::size_t side, const SideVectors& P, const SideVectors& A) {
  SideMatrix& K = side_stiffness_[side];
  ForEach<8>([&]<int j>() {
    constexpr int kRows = Rows(j);
    K.col(j).template tail<kRows>() +=
        P.col(0).template tail<kRows>() * A(j, 0) + P.col(1).template tail<kRows>() * A(j, 1) +
        P.col(2).template tail<kRows>() * A(j, 2) + P.col(3).template tail<kRows>() * A(j, 3);
  });
}

void LinkageEquations::AddAt(int dof, double force, double stiffness) {
  force_[dof] += force;
  diagonal_[dof] += stiffness;
}

// Cholesky's L D L' of a positive definite matrix, without pivots. The two bogies share no term and
// go first; what is left is that of the coordinates that both sides have, with the force as row 7.
LinkageVector LinkageEquations::Solve() const {
  SideMatrix K = side_stiffness_[0] + side_stiffness_[1];
  K.row(kShared).head<kShared>() = force_.head<kShared>().transpose();
  std::array<Eigen::Matrix<double, kShared, 1>, 2> bogie;
  for (std::size_t side = 0; side < 2; ++side) {
    const int dof = kFirstBogieDof + static_cast<int>(side);
    const SideMatrix& of_side = side_stiffness_[side];
    const double inverse = 1.0 / (of_side(kShared, kShared) + diagonal_[dof]);
    SideVector row;
    row << of_side.row(kShared).head<kShared>().transpose(), force_[dof];
    bogie[side] = inverse * row.head<kShared>();
    ForEach<kShared>([&]<int j>() {
      K.col(j).template tail<Rows(j)>() -= row.template tail<Rows(j)>() * bogie[side][j];
    });
  }
  LinkageVector x;
  for (int j = 0; j < kShared; ++j) K(j, j) += diagonal_[j];
  ForEach<kShared>([&]<int j>() {
    x[j] = 1.0 / K(j, j);
    ForEach<kShared - 1 - j>([&]<int below>() {
      constexpr int k = j + 1 + below;
      K.col(k).template tail<Rows(k)>() -= K.col(j).template tail<Rows(k)>() * (K(k, j) * x[j]);
    });
  });
  // From the last row up: x_j = (f_j - sum over k > j of L_kj x_k) / D_j.
  for (int j = kShared - 1; j >= 0; --j) {
    double rest = K(kShared, j);
    for (int k = j + 1; k < kShared; ++k) rest -= K(k, j) * x[k];
    x[j] *= rest;
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const int dof = kFirstBogieDof + static_cast<int>(side);
    x[dof] = force_[dof] / (side_stiffness_[side](kShared, kShared) + diagonal_[dof]) -
             bogie[side].dot(x.head<kShared>());
  }
  return x;
}

}  // namespace rockyard::rover
