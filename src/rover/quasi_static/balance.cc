#include "rover/quasi_static/balance.h"

#include <algorithm>
#include <cmath>

namespace rockyard::rover {
namespace {

using math::Vector3;

// Speed at which motion resistance has reached 0.7 of itself, in shares of the rim speed.
constexpr double kResistanceCreep = 0.003;
// The slip of a wheel that stands, or turns slowly, while others turn is measured in shares of this
// share of the fastest rim.
constexpr double kMinReference = 0.05;
// Where all wheels stand, slip is measured in shares of this share of the top speed: friction then
// lets them creep by 24 um/s at 0.15 m/s, which no balance at rest lasts long enough to show.
constexpr double kStandingReference = 0.08;
// Largest last change of the rates, over the top speed. The error that it leaves is far smaller.
constexpr double kSettledChange = 1e-2;
// Force that a rover at rest may be left with, over its weight.
constexpr double kBalanced = 0.01;
// Change of the rates, over the top speed, below which tractions are taken along their tangent; at
// larger changes they are taken along their chord (force over speed), which does not overshoot.
constexpr double kTangentRange = 0.3;
// A step of Newton's method is cut where the slope at its end has the other sign and more than this
// share of the size of the slope at its start.
constexpr double kOvershoot = 0.3;
constexpr int kMaxCuts = 6;
// Change of a load, over the mean wheel load, from which on its traction follows it; and the
// largest step by which it follows, over the same.
constexpr double kLoadTolerance = 0.05;
constexpr double kLoadStep = 0.5;
// Least arm of a contact about the axle, over the wheel radius.
constexpr double kLeastArm = 1e-6;
// Damping of a coordinate that does not move.
constexpr double kHeld = 1e12;
// A wheel that has dug in for a slip this near to its own has done so: less than a hundredth of the
// sinkage is left.
constexpr double kDugIn = 2e-3;

// Returns the rates that move one side: the six of the chassis, the rocker, and that side's bogie.
SideVector OfSide(const LinkageVector& rates, std::size_t side) {
  SideVector result;
  result << rates.head<7>(), rates[kFirstBogieDof + static_cast<int>(side)];
  return result;
}

}  // namespace

QuasiStaticBalance::QuasiStaticBalance(const RoverParams& params, const terrain::SoilParams& soil)
    : contact_params_(params.contact),
      soil_(MakeWheelOnSoil(params, soil), params.mass.total_kg * params.physics.gravity_m_s2),
      sinkage_(soil, soil_.soil(), params.geometry.wheel_radius_m,
               params.mass.total_kg * params.physics.gravity_m_s2 / messages::kWheelCount),
      lags_(sinkage_.enabled() && (soil.law == terrain::WheelLaw::kBekker ||
                                   sinkage_.length_m() > params.quasi_static.settle_distance_m)),
      wheel_radius_m_(params.geometry.wheel_radius_m),
      stall_torque_Nm_(params.drive.stall_torque_Nm),
      stop_rad_{params.geometry.rocker_limit_rad, params.geometry.bogie_limit_rad,
                params.geometry.bogie_limit_rad},
      speed_m_s_(params.drive.speed_m_s),
      mean_load_N_(params.mass.total_kg * params.physics.gravity_m_s2 / 6.0),
      stop_stiffness_Nm_(params.contact.stiffness_N_m * params.geometry.length_m *
                         params.geometry.length_m / 16.0) {
  // D: at full speed the damping takes 0.03 % of the weight; about an axis, of the weight at an arm
  // of a quarter of the rover's length.
  const double per_speed = 3e-4 * 6.0 * mean_load_N_ / params.drive.speed_m_s;
  const double arm_m = 0.25 * params.geometry.length_m;
  free_damping_.setConstant(per_speed * arm_m * arm_m);
  free_damping_.head<3>().setConstant(per_speed);
}

void QuasiStaticBalance::MakeRow(const Linkage& linkage, const Drive& drive,
                                 const LinkageVector& rates, RestingContact& contact,
                                 Row& row) const {
  const PointMotion motion = linkage.MotionOf(contact.body, contact.p_W);
  row.side = Linkage::SideOf(contact.body);
  row.stiffness_N_m = contact_params_.stiffness_N_m;
  row.rest_m = row.rim_m_s = row.arm_m = 0.0;
  row.reference_m_s = rim_speed_m_s_;
  row.loaded = contact.load_N > 0.0;
  row.soil = contact.IsSoil();
  row.foretold_along_N = contact.traction_N[0];
  row.foretold_across_N = contact.traction_N[1];
  const Vector3 axle_W =
      linkage.axle_W(static_cast<std::size_t>(contact.IsWheel() ? contact.part : 0));
  Vector3 along_W = axle_W.cross(contact.n_W);
  // axle x normal is the rolling direction; a wheel met at its side face has none.
  if (along_W.squaredNorm() < 1e-6) along_W = contact.n_W.unitOrthogonal();
  along_W.normalize();
  // Rows in the space of the rates: row . w is the velocity of the contact point along that
  // direction.
  row.directions.col(kNormal) = motion.Along(contact.n_W);
  row.directions.col(kAlong) = motion.Along(along_W);
  row.directions.col(kAcross) = motion.Along(contact.n_W.cross(along_W));
  if (row.soil) {
    row.directions.col(kAxle) =
        linkage.MotionOf(contact.body, linkage.body(contact.body).p_WB).Along(along_W);
  } else {
    row.directions.col(kAxle).setZero();
  }
  row.speed = row.directions.transpose() * OfSide(rates, row.side);
  // The contact was found lead_s ahead at these rates; its gap changes at the rate n . J w, so this
  // is the gap at the beginning of the step.
  row.gap_m = contact.gap_m - drive.lead_s * row.speed[kNormal];
  if (contact.IsWheel()) {
    MakeWheelRow(drive, contact, axle_W.cross(contact.p_W - linkage.wheel_W(contact.part)).norm(),
                 row);
  } else {
    SetTraction(contact, row);
  }
}

void QuasiStaticBalance::MakeWheelRow(const Drive& drive, RestingContact& contact, double arm_m,
                                      Row& row) const {
  const auto wheel = static_cast<std::size_t>(contact.part);
  row.wheel = wheel;
  const double rate_rad_s = drive.rate_rad_s[wheel];
  // The rim's velocity against the axle at the contact is omega axle x arm: backwards, against
  // `along`, for a wheel that rolls forward. The motor feels a force along it by the same arm.
  row.arm_m = arm_m;
  row.rim_m_s = rate_rad_s * row.arm_m;
  // A contact at the axle itself asks nothing of the motor.
  row.stall_N = stall_torque_Nm_ / std::max(row.arm_m, kLeastArm * wheel_radius_m_);
  row.reference_m_s = std::max(std::abs(rate_rad_s) * wheel_radius_m_,
                               (rims_turn_ ? kMinReference : 1.0) * rim_speed_m_s_);
  if (contact.traction_load_N == 0.0) contact.traction_load_N = mean_load_N_;
  if (!row.soil) return SetTraction(contact, row);
  // The sinkage curve in series with the contact's own spring, along its tangent at the last load.
  const double load_N = contact.load_N > 0.0 ? contact.load_N : mean_load_N_;
  const SoilAnswer soil = soil_.At(load_N, sinkage_.dug_slip(wheel));
  const double k = contact_params_.stiffness_N_m;
  row.stiffness_N_m = 1.0 / (1.0 / soil.stiffness_N_m + 1.0 / k);
  // Tangent at the load N_0: N = N_0 + k_row (depth - z(N_0) - N_0 / k), which has N = 0 at the
  // depth
  //   rest = z(N_0) + N_0 / k - N_0 / k_row.
  row.rest_m = soil.sinkage_m + load_N / k - load_N / row.stiffness_N_m;
  if (contact.traction_load_N != load_N) return SetTraction(contact, row);
  SetSoilTraction(soil, row);
}

void QuasiStaticBalance::SetTraction(const RestingContact& contact, Row& row) const {
  const double load_N = contact.traction_load_N;
  if (row.soil) return SetSoilTraction(soil_.At(load_N, sinkage_.dug_slip(row.wheel)), row);
  row.creep_m_s = kRockCreep * row.reference_m_s;
  row.shear_ratio = row.resistance_N = row.side_N = 0.0;
  const bool wheel_on_rock = contact.IsWheel() && contact.other >= 0;
  row.max_N = load_N * (wheel_on_rock ? contact_params_.wheel_rock_friction
                                      : contact_params_.body_rock_friction);
  // Settling: no rim turns, and contacts are without traction.
  if (row.reference_m_s == 0.0) row.max_N = 0.0;
  row.motor_bound = wheel_on_rock && row.max_N > row.stall_N;
}

void QuasiStaticBalance::SetSoilTraction(const SoilAnswer& soil, Row& row) const {
  row.creep_m_s = kRockCreep * row.reference_m_s;
  const bool settles = row.reference_m_s == 0.0;
  row.max_N = settles ? 0.0 : soil.traction_N;
  row.motor_bound = row.max_N > row.stall_N;
  // A braked wheel holds up to its traction, without the creep of one that turns.
  row.shear_ratio = row.rim_m_s != 0.0 ? soil.shear_ratio : 0.0;
  row.u_per_speed_s_m = settles ? 0.0 : row.shear_ratio / row.reference_m_s;
  row.resistance_N = settles ? 0.0 : soil.resistance_N;
  row.side_N = settles ? 0.0 : soil.side_N;
}

QuasiStaticBalance::Traction QuasiStaticBalance::TractionOf(const Row& row,
                                                            double speed_m_s) const {
  if (row.shear_ratio > 0.0) {
    // Soil, with the slip i = v / v_ref and u = i l / K:
    //   F = T_max tau(u),  F / v = T_max (l / K) / v_ref tau / u,  dF/dv = T_max (l / K) / v_ref
    //   tau'.
    // tau / u tends to 1/2 at u = 0.
    const double u = speed_m_s * row.u_per_speed_s_m;
    const ShearShare share = share_.At(u);
    const double scale = row.max_N * row.u_per_speed_s_m;
    constexpr double kSmall = 1e-6;
    return {scale * (u > kSmall ? share.value / u : 0.5), scale * share.slope};
  }
  // Rock, Coulomb's law made smooth:
  //   F = mu N v / sqrt(v^2 + v_c^2),  dF/dv = F / v v_c^2 / (v^2 + v_c^2),  v_c = i_c v_ref.
  const double creep2 = row.creep_m_s * row.creep_m_s;
  const double root2 = speed_m_s * speed_m_s + creep2;
  const double per_speed = row.max_N / std::sqrt(root2);
  return {per_speed, per_speed * creep2 / root2};
}

// With g(v) = F(v) / v the derivative of F = g v is g I + c v v', c = (F' - g) / v^2. Near a wheel
// that sticks F bends so much that Newton's method would overshoot it again and again. One of the
// two v is therefore that at which the traction would be as the last step of Newton's method
// foretold (Chan, Golub and Mulet 1999): 0 where nothing is foretold, so that g alone is left, the
// chord, which is never less than the tangent; v itself in the solution.
void QuasiStaticBalance::AcrossTheNormal(double along_m_s, double across_m_s, Row& row) const {
  const double v_m_s = std::sqrt(along_m_s * along_m_s + across_m_s * across_m_s);
  const Traction at = TractionOf(row, v_m_s);
  row.slip_m_s = v_m_s;
  row.traction = {at.per_speed * along_m_s, at.per_speed * across_m_s, at.per_speed, 0.0,
                  at.per_speed};
  const double a_N = row.foretold_along_N;
  const double b_N = row.foretold_across_N;
  const double foretold_N = std::sqrt(a_N * a_N + b_N * b_N);
  if (v_m_s == 0.0 || foretold_N == 0.0) return;
  // No faster than v, so that the derivative stays positive.
  const double per_force = std::min(1.0 / at.per_speed, v_m_s / foretold_N);
  const double bend = (at.slope - at.per_speed) / (v_m_s * v_m_s) * per_force;
  row.traction.k_aa += bend * a_N * along_m_s;
  row.traction.k_bb += bend * b_N * across_m_s;
  row.traction.k_ab = 0.5 * bend * (a_N * across_m_s + b_N * along_m_s);
}

void QuasiStaticBalance::Foretell(double share, Row& row) {
  const Tangential& from = row.before;
  const Speeds& change = row.change;
  row.foretold_along_N =
      from.along_N - share * (from.k_aa * change[kAlong] + from.k_ab * change[kAcross]);
  row.foretold_across_N =
      from.across_N - share * (from.k_ab * change[kAlong] + from.k_bb * change[kAcross]);
}

// The rim falls back until the ground asks for the stall force S along it. The slip is then large
// against what is left of the rim's speed, so that soil, too, answers with all of its traction T,
// and what S leaves of T acts across the wheel, smooth as on rock:
//
//   F_across = sqrt(T^2 - S^2) b / sqrt(b^2 + v_c^2),  a' = S sqrt(b^2 + v_c^2) / sqrt(T^2 - S^2).
void QuasiStaticBalance::GiveWay(double along_m_s, double across_m_s, Row& row) const {
  const double creep2 = row.creep_m_s * row.creep_m_s;
  const double root2 = across_m_s * across_m_s + creep2;
  const double per_speed = std::sqrt((row.max_N * row.max_N - row.stall_N * row.stall_N) / root2);
  const double left_m_s = std::min(std::abs(along_m_s), row.stall_N / per_speed);
  row.slip_m_s = std::sqrt(left_m_s * left_m_s + across_m_s * across_m_s);
  row.yield_m_s = along_m_s - std::copysign(left_m_s, along_m_s);
  row.traction = {std::copysign(row.stall_N, along_m_s), per_speed * across_m_s,
                  near_ ? 0.0 : row.stall_N / std::abs(along_m_s), 0.0,
                  near_ ? per_speed * creep2 / root2 : per_speed};
}

void QuasiStaticBalance::SetForces(const Speeds& speed, RestingContact& contact, Row& row) {
  row.acts = false;
  row.slip_m_s = row.yield_m_s = 0.0;
  row.traction = {};
  row.axle_N = row.k_axle = row.face_N = row.k_face = 0.0;
  // Penetration at the end of the step; N = k (depth - rest).
  contact.depth_m = -row.gap_m - step_s_ * speed[kNormal];
  contact.load_N = row.stiffness_N_m * (contact.depth_m - row.rest_m);
  contact.sliding_speed_m_s = 0.0;
  // An open contact has no force. In the first evaluation a contact that bore load before keeps its
  // spring all the same: a far-off start would else open contacts that the solution has closed.
  if (contact.load_N <= 0.0 && !(first_ && row.loaded)) {
    contact.load_N = 0.0;
    return;
  }
  // Tractions do not follow the loads of the first evaluation, whose rates are only guessed.
  if (contact.load_N > 0.0 && !first_) FollowLoad(contact, row);
  row.acts = true;
  if (row.max_N == 0.0) return;
  // Slip velocity s: the rim's minus that of the axle's point over the ground. The force on the
  // rover is along s.
  const double along = row.rim_m_s - speed[kAlong];
  const double across = -speed[kAcross];
  AcrossTheNormal(along, across, row);
  if (row.motor_bound && std::abs(row.traction.along_N) > row.stall_N) GiveWay(along, across, row);
  contact.sliding_speed_m_s = row.slip_m_s;
  if (!row.soil) return;
  // The motion resistance is against the axle's motion along the wheel, which has to overcome it by
  // traction; beside it, what the soil does to the side face of a wheel that slides across.
  const Bounded axle = Against(speed[kAxle], row.resistance_N, row);
  row.axle_N = axle.force_N;
  row.k_axle = axle.stiffness;
  if (row.side_N <= 0.0) return;
  const Bounded side = Against(speed[kAcross], row.side_N, row);
  row.face_N = side.force_N;
  row.k_face = side.stiffness;
}

// The forces along the directions of a row.
QuasiStaticBalance::Speeds QuasiStaticBalance::Forces(const RestingContact& contact,
                                                      const Row& row) {
  return {contact.load_N, row.traction.along_N, row.traction.across_N + row.face_N, row.axle_N};
}

// F v / sqrt(v^2 + v_c^2), the smooth sign of v, and its derivative as in TractionOf.
QuasiStaticBalance::Bounded QuasiStaticBalance::Against(double speed_m_s, double force_N,
                                                        const Row& row) {
  const double creep_m_s = kResistanceCreep * row.reference_m_s;
  const double root2 = speed_m_s * speed_m_s + creep_m_s * creep_m_s;
  const double per_speed = force_N / std::sqrt(root2);
  return {-per_speed * speed_m_s, per_speed * creep_m_s * creep_m_s / root2};
}

// Beyond a stop a spring turns the joint back: torque -k (|angle| - stop) sign(angle).
double QuasiStaticBalance::StopTorque_Nm(int dof, double rate) const {
  const auto i = static_cast<std::size_t>(dof - kRockerDof);
  const double angle_rad = i == 0 ? posture_.rocker_rad : posture_.bogie_rad[i - 1];
  const double end_rad = angle_rad + step_s_ * rate;
  const double beyond_rad = std::max(0.0, std::abs(end_rad) - stop_rad_[i]);
  return -std::copysign(stop_stiffness_Nm_ * beyond_rad, end_rad);
}

// F(w) = Q_gravity - D w + contacts + stops, and minus its derivative: D, h k n n' along the
// normals, and K_aa, K_ab, K_bb in the tangent planes.
void QuasiStaticBalance::Assemble(const LinkageVector& rates,
                                  const std::vector<RestingContact>& contacts) {
  equations_.Reset(gravity_ - damping_.cwiseProduct(rates), damping_);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Row& row = rows_[i];
    row.before = row.traction;
    if (!row.acts) continue;
    const double k_n = step_s_ * row.stiffness_N_m;
    const Tangential& at = row.traction;
    const SideVectors& A = row.directions;
    equations_.AddForce(row.side, A * Forces(contacts[i], row));
    SideVectors P;
    P.col(kNormal) = k_n * A.col(kNormal);
    P.col(kAlong) = at.k_aa * A.col(kAlong) + at.k_ab * A.col(kAcross);
    P.col(kAcross) = at.k_ab * A.col(kAlong) + (at.k_bb + row.k_face) * A.col(kAcross);
    P.col(kAxle) = row.k_axle * A.col(kAxle);
    equations_.AddStiffness(row.side, P, A);
  }
  for (int dof = kRockerDof; dof < kLinkageDof; ++dof) {
    const double torque_Nm = StopTorque_Nm(dof, rates[dof]);
    if (torque_Nm != 0.0) equations_.AddAt(dof, torque_Nm, step_s_ * stop_stiffness_Nm_);
  }
}

double QuasiStaticBalance::MotorTorque_Nm(std::size_t wheel) const {
  double torque_Nm = 0.0;
  for (const Row& row : rows_) {
    if (row.acts && row.wheel == wheel) torque_Nm += row.arm_m * row.traction.along_N;
  }
  return torque_Nm;
}

// The linear velocity counts as it is, each of the six angular rates by the speed that it would
// give a wheel's rim.
bool QuasiStaticBalance::IsSmall(const LinkageVector& change, double speed_m_s) const {
  return change.head<3>().squaredNorm() < speed_m_s * speed_m_s &&
         change.tail<6>().cwiseAbs().maxCoeff() * wheel_radius_m_ < speed_m_s;
}

// Rates of a rover at rest are so small that their change does not say whether forces balance.
bool QuasiStaticBalance::IsBalanced() const {
  return equations_.force().head<3>().norm() < kBalanced * messages::kWheelCount * mean_load_N_;
}

// Traction follows load by bounded steps: loads of a first guess can be far off.
void QuasiStaticBalance::FollowLoad(RestingContact& contact, Row& row) {
  const double change_N = contact.load_N - contact.traction_load_N;
  if (std::abs(change_N) < kLoadTolerance * mean_load_N_) return;
  const double max_N = kLoadStep * mean_load_N_;
  contact.traction_load_N += std::clamp(change_N, -max_N, max_N);
  SetTraction(contact, row);
  if (std::abs(change_N) > max_N) traction_lags_ = true;
}

// Lets a last small change of the rates move the loads along the springs; the tractions stay.
void QuasiStaticBalance::Finish(std::vector<RestingContact>& contacts) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Foretell(1.0, rows_[i]);
    contacts[i].traction_N = {rows_[i].foretold_along_N, rows_[i].foretold_across_N};
    if (contacts[i].load_N <= 0.0) continue;
    const double deeper_m = -step_s_ * rows_[i].change[kNormal];
    contacts[i].depth_m += deeper_m;
    contacts[i].load_N = std::max(0.0, contacts[i].load_N + rows_[i].stiffness_N_m * deeper_m);
    contacts[i].traction_load_N = contacts[i].load_N;
  }
}

// Along the change every speed is linear in its share, so that contacts are evaluated by their
// speeds alone, without the space of the rates.
double QuasiStaticBalance::EvaluateAlong(const LinkageVector& rates, const LinkageVector& change,
                                         double share, std::vector<RestingContact>& contacts) {
  traction_lags_ = false;
  double slope =
      (gravity_ - damping_.cwiseProduct(LinkageVector(rates + share * change))).dot(change);
  for (int dof = kRockerDof; dof < kLinkageDof; ++dof) {
    slope += StopTorque_Nm(dof, rates[dof] + share * change[dof]) * change[dof];
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Row& row = rows_[i];
    SetForces(row.speed + share * row.change, contacts[i], row);
    slope += Forces(contacts[i], row).dot(row.change);
  }
  return slope;
}

// With its tractions given, the function is convex and F is minus its gradient, so F . change falls
// along the way. Where it has turned its sign, the minimum lies before, and a secant through the
// bracket says where (an end that stays counts half, as in the Illinois rule).
double QuasiStaticBalance::Search(const LinkageVector& rates, const LinkageVector& change,
                                  double drop, std::vector<RestingContact>& contacts) {
  double low = 0.0;
  double high = 1.0;
  double slope_low = drop;
  double slope_high = EvaluateAlong(rates, change, 1.0, contacts);
  if (slope_high >= -kOvershoot * drop) return 1.0;
  double share = 1.0;
  for (int cut = 0; cut < kMaxCuts; ++cut) {
    share = low + (high - low) * slope_low / (slope_low - slope_high);
    const double slope = EvaluateAlong(rates, change, share, contacts);
    if (std::abs(slope) <= kOvershoot * drop) break;
    if (slope > 0.0) {
      low = share;
      slope_low = slope;
      slope_high *= 0.5;
    } else {
      high = share;
      slope_high = slope;
      slope_low *= 0.5;
    }
  }
  return share;
}

int QuasiStaticBalance::Solve(const Linkage& linkage, const Posture& posture, const Drive& drive,
                              std::vector<RestingContact>& contacts, LinkageVector& rates) {
  // The fastest rim. Where none turns, a share of the top speed stands for it, so that slip stays
  // defined.
  rim_speed_m_s_ = drive.freedom == Freedom::kSettling ? 0.0 : kStandingReference * speed_m_s_;
  rims_turn_ = false;
  for (const double rate : drive.rate_rad_s) {
    rims_turn_ |= rate != 0.0;
    rim_speed_m_s_ = std::max(rim_speed_m_s_, std::abs(rate) * wheel_radius_m_);
  }
  step_s_ = drive.step_s;
  posture_ = posture;
  gravity_ = linkage.Gravity();
  damping_ = free_damping_;
  // Held by hand: x, y and the rotation about W's z do not move.
  if (drive.freedom == Freedom::kSettling) damping_[0] = damping_[1] = damping_[5] = kHeld;
  rows_.resize(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    RestingContact& contact = contacts[i];
    MakeRow(linkage, drive, rates, contact, rows_[i]);
  }
  first_ = true;
  traction_lags_ = false;
  // The last rates of a drive that goes on, or of a rover at rest, are a good start.
  near_ = drive.lead_s > 0.0 || (!rims_turn_ && drive.freedom == Freedom::kAll);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    SetForces(rows_[i].speed, contacts[i], rows_[i]);
  first_ = false;
  // Newton's method: (D - dF/dw) change = F, until the change is small and no traction waits for
  // its load.
  for (int iteration = 1; iteration < kMaxIterations; ++iteration) {
    Assemble(rates, contacts);
    const LinkageVector change = equations_.Solve();
    const std::array<SideVector, 2> side_change{OfSide(change, 0), OfSide(change, 1)};
    for (Row& row : rows_) row.change = row.directions.transpose() * side_change[row.side];
    if (near_ && !traction_lags_ && IsSmall(change, kSettledChange * speed_m_s_) &&
        (rims_turn_ || IsBalanced())) {
      rates += change;
      Finish(contacts);
      FollowSlips();
      return iteration;
    }
    near_ = IsSmall(change, kTangentRange * speed_m_s_);
    const double share = Search(rates, change, equations_.force().dot(change), contacts);
    rates += share * change;
    for (Row& row : rows_) {
      Foretell(share, row);
      row.speed += share * row.change;
    }
  }
  FollowSlips();
  return kMaxIterations;
}

messages::PerWheel<double> QuasiStaticBalance::TurnShares() const {
  messages::PerWheel<double> shares;
  shares.fill(1.0);
  for (const Row& row : rows_) {
    if (!row.acts || row.yield_m_s == 0.0 || row.rim_m_s == 0.0) continue;
    const double share = 1.0 - row.yield_m_s / row.rim_m_s;
    shares[row.wheel] = std::min(shares[row.wheel], std::clamp(share, 0.0, 1.0));
  }
  return shares;
}

// The slip of a wheel whose motor gives way is that over its slower rim. Wheels off the soil have
// no slip.
messages::PerWheel<double> QuasiStaticBalance::SoilSlips() const {
  messages::PerWheel<double> slips{};
  for (const Row& row : rows_) {
    const double rim_m_s = std::abs(row.rim_m_s - row.yield_m_s);
    if (!row.acts || !row.soil || rim_m_s == 0.0) continue;
    slips[row.wheel] = std::max(slips[row.wheel], std::min(row.slip_m_s / rim_m_s, 1.0));
  }
  return slips;
}

void QuasiStaticBalance::Dig(const messages::PerWheel<double>& rim_way_m, double way) {
  if (!lags_) return;
  const messages::PerWheel<double> slip = SoilSlips();
  for (std::size_t i = 0; i < slip.size(); ++i) {
    // A slip along the wheel: 1 - v / (omega r), with v as much longer or shorter as the way.
    const double now = way == 1.0 ? slip[i] : std::abs(1.0 - way * (1.0 - slip[i]));
    sinkage_.Roll(i, now, rim_way_m[i]);
  }
}

bool QuasiStaticBalance::IsDugIn(const messages::PerWheel<double>& slip) const {
  for (std::size_t i = 0; i < slip.size(); ++i) {
    if (std::abs(slip[i] - sinkage_.dug_slip(i)) >= kDugIn) return false;
  }
  return true;
}

bool QuasiStaticBalance::HasDugIn() const {
  if (!sinkage_.enabled()) return true;
  return lags_ ? IsDugIn(SoilSlips()) : dug_in_;
}

void QuasiStaticBalance::FollowSlips() {
  if (!sinkage_.enabled() || lags_ || !rims_turn_) return;
  const messages::PerWheel<double> slip = SoilSlips();
  dug_in_ = IsDugIn(slip);
  for (std::size_t i = 0; i < slip.size(); ++i) sinkage_.Set(i, slip[i]);
}

SteadyDrive QuasiStaticBalance::Steady(const LinkageVector& rates) const {
  SteadyDrive drive;
  for (const Row& row : rows_) {
    if (!row.acts || row.rim_m_s == 0.0) continue;
    const SideVector w = OfSide(rates, row.side);
    WheelLump& lump = row.shear_ratio > 0.0 ? drive.soil : drive.rock;
    const double max_N = row.motor_bound ? row.stall_N : row.max_N;
    lump.traction_N += max_N;
    // Backwards is along, too: all speeds count the way that the rim turns.
    lump.rim_m_s += max_N * std::abs(row.rim_m_s);
    const double along_m_s = row.directions.col(kAlong).dot(w);
    lump.along_m_s += max_N * std::copysign(along_m_s, along_m_s * row.rim_m_s);
    lump.across_m_s += max_N * std::abs(row.directions.col(kAcross).dot(w));
    lump.shear_ratio += max_N * row.shear_ratio;
  }
  for (WheelLump* lump : {&drive.soil, &drive.rock}) {
    if (lump->traction_N == 0.0) continue;
    lump->rim_m_s /= lump->traction_N;
    lump->along_m_s /= lump->traction_N;
    lump->across_m_s /= lump->traction_N;
    lump->shear_ratio /= lump->traction_N;
  }
  return drive;
}

}  // namespace rockyard::rover
