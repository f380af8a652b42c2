#include "rover/multibody/constraint_solver.h"

#include <algorithm>
#include <cmath>

namespace rockyard::rover {
namespace {

// Share of a position error of differential or joint stop that one step takes back.
constexpr double kJointRecovery = 0.2;
// Joint stops are watched from this angle before them, rad.
constexpr double kStopWatch_rad = 0.05;
// Contacts that free motion would bring this near within the step are solved, m; the distance
// leaves room for what other contacts change about the motion.
constexpr double kActiveGap_m = 0.005;
// Sweeps end where no impulse, N s or N m s, has changed by more than this share of what a wheel
// bears on average.
constexpr double kConverged = 2e-4;

}  // namespace

ConstraintSolver::ConstraintSolver(const RoverParams& params, const terrain::SoilParams& soil)
    : laws_(params, soil),
      stall_torque_Nm_(params.drive.stall_torque_Nm),
      iterations_(params.physics.solver_iterations),
      wheel_radius_m_(params.geometry.wheel_radius_m),
      mean_load_N_(params.mass.total_kg * params.physics.gravity_m_s2 / messages::kWheelCount),
      sinkage_(soil, laws_.soil(), params.geometry.wheel_radius_m, mean_load_N_),
      step_s_(params.physics.step_s) {
  // The differential bar turns one rocker back by what the other turns: sum of the rates 0.
  differential_.J[6 + kLeftRocker] = 1.0;
  differential_.J[6 + kRightRocker] = 1.0;
  differential_.Unbind();
  for (std::size_t i = 0; i < kStops; ++i) {
    const bool rocker = i <= static_cast<std::size_t>(kRightRocker);
    stop_angle_rad_[i] =
        rocker ? params.geometry.rocker_limit_rad : params.geometry.bogie_limit_rad;
  }
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    motors_[i].J[6 + kFirstWheel + static_cast<int>(i)] = 1.0;
    motors_[i].high = stall_torque_Nm_ * step_s_;
    motors_[i].low = -motors_[i].high;
  }
}

void ConstraintSolver::Clear() {
  differential_.impulse = 0.0;
  for (Row& row : stops_) row.impulse = 0.0;
  // The contacts' impulses are forgotten with the contacts.
  for (Row& row : motors_) row.impulse = 0.0;
  sinkage_.Clear();
  slip_.fill(0.0);
}

// Every row starts from its last impulse, then the sweeps go through joints, motors and contacts.
// Records depend on this order of the rows.
void ConstraintSolver::Solve(const Step& step, LooseRocks* loose_rocks, ContactFinder& finder,
                             Multibody& body) {
  const DofMatrix& mass_inverse = step.mass_inverse;
  if (step.duration_s != step_s_) SetStep(step.duration_s, loose_rocks, finder);
  const DofVector free_velocity = body.Velocity();
  velocity_ = free_velocity;
  before_ = step.before;
  // A motor that held its rate begins the step at the rate that its ramp says; a stalled motor
  // begins at the rate that it has.
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const Row& motor = motors_[i];
    if (motor.low < motor.impulse && motor.impulse < motor.high) {
      before_[6 + kFirstWheel + static_cast<int>(i)] = step.rates.from[i];
    }
  }
  StartDifferential(mass_inverse, body);
  StartStops(mass_inverse, body);
  StartMotors(mass_inverse, step.rates.to);
  contact_count_ = 0;
  MarkActive(body, finder);
  if (loose_rocks != nullptr) loose_rocks->Start(finder.contacts());
  for (Contact& contact : finder.contacts()) {
    if (contact.active) {
      LooseRock* rock = loose_rocks != nullptr ? loose_rocks->Find(contact.other) : nullptr;
      StartContact(mass_inverse, finder.part(contact.part), body, rock, contact);
    } else {
      contact.Forget();
    }
  }
  // Braked wheels get all sweeps: what sweeps leave open would let them creep.
  const bool driven = std::any_of(step.rates.to.begin(), step.rates.to.end(),
                                  [](double rate) { return rate != 0.0; });
  const double enough_Ns = driven ? kConverged * mean_load_N_ * step_s_ : 0.0;
  for (std::int64_t i = 0; i < iterations_; ++i) {
    if (Sweep(loose_rocks) < enough_Ns) break;
  }
  for (std::size_t i = 0; i < contact_count_; ++i) {
    KeepForNextStep(contacts_[i]);
  }
  if (sinkage_.enabled()) Dig();
  body.AddVelocity(velocity_ - free_velocity);
}

void ConstraintSolver::SetStep(double step_s, LooseRocks* loose_rocks, ContactFinder& finder) {
  const double ratio = step_s / step_s_;
  step_s_ = step_s;
  differential_.impulse *= ratio;
  for (Row& row : stops_) row.impulse *= ratio;
  for (Row& row : motors_) {
    row.impulse *= ratio;
    row.high = stall_torque_Nm_ * step_s;
    row.low = -row.high;
  }
  finder.ScaleImpulses(ratio);
  if (loose_rocks != nullptr) loose_rocks->SetStep(step_s);
}

void ConstraintSolver::Start(const DofMatrix& mass_inverse, Row& row) {
  // response = M^-1 J', the velocity change per unit impulse. Of the 16 entries of J a contact uses
  // six and those of the joints that carry its part.
  row.response.setZero();
  for (int dof = 0; dof < kDof; ++dof) {
    if (row.J[dof] != 0.0) row.response += row.J[dof] * mass_inverse.col(dof);
  }
  // d(J v + c p)/dp = J M^-1 J' + c. A rock of mass m that yields horizontally along e adds
  // e . e / m.
  row.diagonal = row.J.dot(row.response) + row.softness;
  if (row.rock != nullptr) {
    row.diagonal += row.direction_W.head<2>().squaredNorm() / row.rock->mass_kg;
  }
  row.impulse = std::clamp(row.impulse, row.low, row.high);
  // Warm start: the impulse of the last step acts at once.
  velocity_ += row.impulse * row.response;
  if (row.rock != nullptr) row.rock->PushBack(row.impulse * row.direction_W);
}

void ConstraintSolver::StartDifferential(const DofMatrix& mass_inverse, const Multibody& body) {
  const double error_rad = body.JointAngle(kLeftRocker) + body.JointAngle(kRightRocker);
  differential_.target = -kJointRecovery * error_rad / step_s_;
  Start(mass_inverse, differential_);
}

void ConstraintSolver::StartStops(const DofMatrix& mass_inverse, const Multibody& body) {
  for (std::size_t i = 0; i < kStops; ++i) {
    Row& row = stops_[i];
    const int joint = static_cast<int>(i);
    const double angle_rad = body.JointAngle(joint);
    const double room_rad = stop_angle_rad_[i] - std::abs(angle_rad);
    if (room_rad > kStopWatch_rad) {
      row.high = row.impulse = 0.0;
      continue;
    }
    // J v is the rate away from the stop. It must not use up the room within the step,
    // J v >= -room / h; beyond the stop (room < 0) the share kJointRecovery is taken back.
    row.J[6 + joint] = angle_rad > 0.0 ? -1.0 : 1.0;
    row.target = -(room_rad > 0.0 ? 1.0 : kJointRecovery) * room_rad / step_s_;
    row.high = kUnbounded;
    Start(mass_inverse, row);
  }
}

void ConstraintSolver::StartMotors(const DofMatrix& mass_inverse,
                                   const messages::PerWheel<double>& rate_rad_s) {
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    // A motor holds its rate up to the stall torque: |p| <= torque h.
    motors_[i].target = rate_rad_s[i];
    touches_[i] = false;
    Start(mass_inverse, motors_[i]);
  }
}

void ConstraintSolver::MarkActive(const Multibody& body, ContactFinder& finder) const {
  const DofVector velocity = body.Velocity();
  DofVector J;
  for (Contact& contact : finder.contacts()) {
    contact.active = contact.gap_m < kActiveGap_m;
    if (contact.active) continue;
    body.FillJacobian(finder.part(contact.part).body, contact.p_W, contact.n_W, J);
    // Gap at the end of the step if the motion went on without contacts.
    contact.active = contact.gap_m + step_s_ * J.dot(velocity) < kActiveGap_m;
  }
}

void ConstraintSolver::StartContact(const DofMatrix& mass_inverse, const Part& part,
                                    const Multibody& body, LooseRock* rock, Contact& contact) {
  if (contact_count_ == contacts_.size()) contacts_.emplace_back();
  ContactRows& rows = contacts_[contact_count_++];
  rows.contact = &contact;
  // Laws are those at the loads of the last step, and at the slip that wheels will have dug in for
  // midway, fixed within this one.
  const bool wheel = part.kind == truth::BodyPart::kWheel;
  const double dug_slip = wheel ? DugSlip(static_cast<std::size_t>(contact.part)) : 0.0;
  rows.law = laws_.Of(part, contact, step_s_, dug_slip);
  rows.normal.rock = rows.along.rock = rows.across.rock = rock;
  StartNormal(mass_inverse, part, body, rows);
  StartFriction(mass_inverse, part, body, rows);
  rows.motor = nullptr;
  if (wheel) StartDriven(rows);
  StartDrag(mass_inverse, part, body, rows);
  StartSide(rows);
}

// A spring and damper side by side, solved implicitly: with the separating speed v at the end of
// the step h, penetration d - h v and force F = k (d - h v - d_0) - c v. With F = p / h this is the
// row
//   v + p / (h (h k + c)) = k (d - d_0) / (h k + c),   p >= 0.
// A contact with a gap g > 0 only bounds the approach, v >= -g / h, with the same softness.
void ConstraintSolver::StartNormal(const DofMatrix& mass_inverse, const Part& part,
                                   const Multibody& body, ContactRows& rows) {
  const Contact& contact = *rows.contact;
  const double k = rows.law.stiffness_N_m;
  const double c = laws_.damping_Ns_m();
  body.FillJacobian(part.body, contact.p_W, contact.n_W, rows.normal.J);
  rows.normal.direction_W = contact.n_W;
  rows.normal.target = contact.gap_m > 0.0
                           ? -contact.gap_m / step_s_
                           : -k * (rows.law.rest_depth_m + contact.gap_m) / (step_s_ * k + c);
  rows.normal.softness = 1.0 / (step_s_ * (step_s_ * k + c));
  rows.normal.impulse = contact.impulse_Ns[0];
  rows.normal.high = kUnbounded;
  Start(mass_inverse, rows.normal);
}

void ConstraintSolver::StartFriction(const DofMatrix& mass_inverse, const Part& part,
                                     const Multibody& body, ContactRows& rows) {
  const Contact& contact = *rows.contact;
  body.FillJacobian(part.body, contact.p_W, contact.along_W, rows.along.J);
  body.FillJacobian(part.body, contact.p_W, contact.across_W, rows.across.J);
  rows.along.direction_W = contact.along_W;
  rows.across.direction_W = contact.across_W;
  rows.along.impulse = contact.impulse_Ns[1];
  rows.across.impulse = contact.impulse_Ns[2];
  for (Row* row : {&rows.along, &rows.across}) {
    // Contacts that do not slip hold; FollowSlip sets what soil does.
    row->target = row->softness = 0.0;
    row->Unbind();
    Start(mass_inverse, *row);
  }
  // Off-diagonal of the 2 x 2 block: velocity along per unit impulse across.
  double coupling = rows.along.J.dot(rows.across.response);
  if (const LooseRock* rock = rows.along.rock; rock != nullptr) {
    coupling += contact.along_W.head<2>().dot(contact.across_W.head<2>()) / rock->mass_kg;
  }
  rows.friction.Set(rows.along.diagonal, rows.across.diagonal, coupling);
}

// Finds what the motor's row and the friction rows do to each other.
void ConstraintSolver::StartDriven(ContactRows& rows) {
  const auto wheel = static_cast<std::size_t>(rows.contact->part);
  touches_[wheel] = true;
  rows.motor = &motors_[wheel];
  const double g0 = rows.along.J.dot(rows.motor->response);
  const double g1 = rows.across.J.dot(rows.motor->response);
  rows.motor_coupling = {g0, g1};
  // While the motor holds, its impulse undoes what friction does to the wheel's rate: A - g g' / d.
  const double d = rows.motor->diagonal;
  const FrictionBlock& A = rows.friction;
  rows.driven_friction.Set(A.a0() - g0 * g0 / d, A.a1() - g1 * g1 / d, A.a01() - g0 * g1 / d);
  rows.slip = {};
  if (rows.law.slips) rows.slip_from = {RimSpeed(rows, before_), ContactVelocity(rows, before_)};
}

// Motion resistance acts on the axle, so that the wheel has to overcome it by traction.
void ConstraintSolver::StartDrag(const DofMatrix& mass_inverse, const Part& part,
                                 const Multibody& body, ContactRows& rows) {
  rows.drag.impulse = rows.contact->drag_Ns;
  if (rows.law.drag_ratio == 0.0) return;
  body.FillJacobian(body.Parent(part.body), body.X_WB(part.body).translation(),
                    rows.contact->along_W, rows.drag.J);
  rows.drag.Unbind();
  Start(mass_inverse, rows.drag);
}

// The soil at the side face of a wheel holds it until its own bound is reached, beside the
// friction.
void ConstraintSolver::StartSide(ContactRows& rows) {
  rows.side.impulse = rows.contact->side_Ns;
  if (rows.law.side_ratio == 0.0) return;
  // The row of the friction across, but for its bounds.
  Row& side = rows.side;
  side.J = rows.across.J;
  side.response = rows.across.response;
  side.diagonal = rows.across.diagonal;
  velocity_ += side.impulse * side.response;
}

void ConstraintSolver::KeepForNextStep(const ContactRows& rows) const {
  Contact& contact = *rows.contact;
  contact.impulse_Ns = {rows.normal.impulse, rows.along.impulse, rows.across.impulse};
  contact.drag_Ns = rows.drag.impulse;
  contact.side_Ns = rows.side.impulse;
}

double ConstraintSolver::DugSlip(std::size_t wheel) const {
  if (!sinkage_.enabled()) return 0.0;
  return sinkage_.After(wheel, slip_[wheel], 0.5 * step_s_ * RimSpeed(wheel, before_));
}

// Wheels dig by their mean slip over the step; a wheel that turns off the soil has no slip and
// leaves its hole.
void ConstraintSolver::Dig() {
  const DofVector mean = 0.5 * (before_ + velocity_);
  messages::PerWheel<double> slip_m_s{};
  for (std::size_t i = 0; i < contact_count_; ++i) {
    const ContactRows& rows = contacts_[i];
    if (!rows.law.slips || rows.normal.impulse <= 0.0) continue;
    double& largest_m_s = slip_m_s[static_cast<std::size_t>(rows.contact->part)];
    largest_m_s = std::max(largest_m_s, ContactVelocity(rows, mean).norm());
  }
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const double rim_m_s = RimSpeed(i, mean);
    slip_[i] = rim_m_s > 0.0 ? slip_m_s[i] / rim_m_s : 0.0;
    if (rim_m_s > 0.0) sinkage_.Roll(i, slip_[i], rim_m_s * step_s_);
  }
}

double ConstraintSolver::Sweep(LooseRocks* loose_rocks) {
  largest_change_Ns_ = 0.0;
  Relax(differential_);
  // A stop that is not watched has the upper bound 0.
  for (Row& row : stops_) {
    if (row.high > 0.0) Relax(row);
  }
  // The motor of a wheel that touches something is solved with its friction.
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    if (!touches_[i]) Relax(motors_[i]);
  }
  for (std::size_t i = 0; i < contact_count_; ++i) {
    ContactRows& rows = contacts_[i];
    // Friction after the normal: its bound is that of the normal impulse of this sweep.
    Relax(rows.normal);
    RelaxFriction(rows);
    // |p_drag| <= (R / N) p_n, |p_side| <= (B / N) p_n.
    const double normal_Ns = rows.normal.impulse;
    if (rows.law.drag_ratio > 0.0) RelaxWithin(rows.law.drag_ratio * normal_Ns, rows.drag);
    if (rows.law.side_ratio > 0.0) RelaxWithin(rows.law.side_ratio * normal_Ns, rows.side);
  }
  if (loose_rocks != nullptr) loose_rocks->Hold();
  return largest_change_Ns_;
}

// Returns b - J v - c p, plus e . u for a rock that moves with u: the row sees the motion against
// the rock.
double ConstraintSolver::Residual(const Row& row) const {
  double residual = row.target - row.J.dot(velocity_) - row.softness * row.impulse;
  if (row.rock != nullptr) residual += row.direction_W.dot(row.rock->v_W_m_s);
  return residual;
}

void ConstraintSolver::Apply(double impulse, Row& row) {
  const double change_Ns = impulse - row.impulse;
  if (change_Ns == 0.0) return;
  velocity_ += change_Ns * row.response;
  if (row.rock != nullptr) row.rock->PushBack(change_Ns * row.direction_W);
  row.impulse = impulse;
  largest_change_Ns_ = std::max(largest_change_Ns_, std::abs(change_Ns));
}

void ConstraintSolver::Relax(Row& row) {
  // Gauss-Seidel: the impulse that makes this row exact with all others as they are, then its
  // bounds.
  Apply(std::clamp(row.impulse + Residual(row) / row.diagonal, row.low, row.high), row);
}

void ConstraintSolver::RelaxWithin(double most_Ns, Row& row) {
  row.high = most_Ns;
  row.low = -most_Ns;
  Relax(row);
}

double ConstraintSolver::RimSpeed(std::size_t wheel, const DofVector& velocity) const {
  return std::abs(velocity[6 + kFirstWheel + static_cast<int>(wheel)]) * wheel_radius_m_;
}

double ConstraintSolver::RimSpeed(const ContactRows& rows, const DofVector& velocity) const {
  return RimSpeed(static_cast<std::size_t>(rows.contact->part), velocity);
}

Eigen::Vector2d ConstraintSolver::ContactVelocity(const ContactRows& rows,
                                                  const DofVector& velocity) {
  return {rows.along.J.dot(velocity), rows.across.J.dot(velocity)};
}

// theta v_1 + (1 - theta) v_0 + c p = 0, divided by theta, is a row for v_1.
void ConstraintSolver::FollowSlip(const Eigen::Vector2d& v_m_s, ContactRows& rows) const {
  const WheelSlip slip{RimSpeed(rows, velocity_), v_m_s};
  rows.slip = laws_.StepOfSlip(rows.law, {rows.slip_from, slip, step_s_}, rows.slip.theta);
  const double theta = rows.slip.theta;
  const Eigen::Vector2d target_m_s = -(1.0 - theta) / theta * rows.slip_from.v_m_s;
  rows.along.target = target_m_s.x();
  rows.across.target = target_m_s.y();
  rows.along.softness = rows.across.softness = rows.slip.softness_m_per_Ns / theta;
}

// Returns the right side b of the block of both friction rows: what remains without the impulses p
// of these rows. `lack` is what the rows lack to their targets, softness left out: b = lack + A p.
std::array<double, 2> ConstraintSolver::RightSide(const ContactRows& rows,
                                                  const FrictionBlock& block,
                                                  const Eigen::Vector2d& lack) {
  const double along = rows.along.impulse;
  const double across = rows.across.impulse;
  return {lack[0] + block.a0() * along + block.a01() * across,
          lack[1] + block.a01() * along + block.a1() * across};
}

void ConstraintSolver::RelaxFriction(ContactRows& rows) {
  Eigen::Vector2d v_m_s = ContactVelocity(rows, velocity_);
  if (rows.law.slips) FollowSlip(v_m_s, rows);
  if (const LooseRock* rock = rows.along.rock; rock != nullptr) {
    // A row sees the motion against the rock.
    v_m_s.x() -= rows.along.direction_W.dot(rock->v_W_m_s);
    v_m_s.y() -= rows.across.direction_W.dot(rock->v_W_m_s);
  }
  const Eigen::Vector2d lack_m_s = Eigen::Vector2d(rows.along.target, rows.across.target) - v_m_s;
  if (rows.motor != nullptr) return RelaxDrivenFriction(lack_m_s, rows);
  const auto [along, across] =
      rows.friction.Solve(RightSide(rows, rows.friction, lack_m_s), rows.along.softness,
                          rows.law.friction * rows.normal.impulse);
  Apply(along, rows.along);
  Apply(across, rows.across);
}

// Solves the motor of a wheel and the friction at its contact together. Solved one after the other,
// each would undo what the other did to the light wheel, and the heavy rover between them would
// take some hundred sweeps to move.
void ConstraintSolver::RelaxDrivenFriction(const Eigen::Vector2d& lack_m_s, ContactRows& rows) {
  Row& motor = *rows.motor;
  const Eigen::Vector2d& g = rows.motor_coupling;
  const double most_Ns = rows.law.friction * rows.normal.impulse;
  // The motor holds its rate: its impulse changes by dq = (lack of its row - g . dp) / d.
  const double hold_Ns = Residual(motor) / motor.diagonal;
  auto p = rows.driven_friction.Solve(RightSide(rows, rows.driven_friction, lack_m_s - hold_Ns * g),
                                      rows.along.softness, most_Ns);
  double q =
      motor.impulse + hold_Ns -
      (g[0] * (p[0] - rows.along.impulse) + g[1] * (p[1] - rows.across.impulse)) / motor.diagonal;
  if (q < motor.low || q > motor.high) {
    // The motor stalls: its torque is given, and friction alone decides how the wheel turns.
    q = std::clamp(q, motor.low, motor.high);
    p = rows.friction.Solve(RightSide(rows, rows.friction, lack_m_s - (q - motor.impulse) * g),
                            rows.along.softness, most_Ns);
  }
  Apply(q, motor);
  Apply(p[0], rows.along);
  Apply(p[1], rows.across);
}

}  // namespace rockyard::rover
