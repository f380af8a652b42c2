#include "rover/constraint_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rockyard::rover {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
// Share of a position error of differential or joint stop that one step takes back.
constexpr double kJointRecovery = 0.2;
// Joint stops are watched from this angle before them, rad.
constexpr double kStopWatch_rad = 0.05;
// Loads below this are taken as this where the soil's answer is looked up, N: a wheel that has just
// touched has none, and all of it vanishes with the load.
constexpr double kLeastLoad_N = 0.1;

}  // namespace

ConstraintSolver::ConstraintSolver(const RoverParams& params, const terrain::SoilParams& soil)
    : contact_params_(params.contact),
      soil_(soil, params.geometry.wheel_radius_m, params.geometry.wheel_width_m),
      wheel_radius_m_(params.geometry.wheel_radius_m),
      step_s_(params.physics.step_s),
      iterations_(params.physics.solver_iterations) {
  differential_.J[6 + kLeftRocker] = 1.0;
  differential_.J[6 + kRightRocker] = 1.0;
  differential_.low = -kUnbounded;
  differential_.high = kUnbounded;
  for (std::size_t i = 0; i < kStops; ++i) {
    const bool rocker = i <= static_cast<std::size_t>(kRightRocker);
    stop_angle_rad_[i] =
        rocker ? params.geometry.rocker_limit_rad : params.geometry.bogie_limit_rad;
  }
  const double stall_Ns_m = params.drive.stall_torque_Nm * step_s_;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    motors_[i].J[6 + kFirstWheel + static_cast<int>(i)] = 1.0;
    motors_[i].low = -stall_Ns_m;
    motors_[i].high = stall_Ns_m;
  }
}

void ConstraintSolver::Clear() {
  differential_.impulse = 0.0;
  for (Row& row : stops_) row.impulse = 0.0;
  for (Row& row : motors_) row.impulse = 0.0;
}

void ConstraintSolver::Solve(const DofMatrix& mass_inverse,
                             const messages::PerWheel<double>& wheel_rate_rad_s,
                             LooseRocks* loose_rocks, ContactFinder& finder, Multibody& body) {
  const DofVector free_velocity = body.Velocity();
  velocity_ = free_velocity;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    spin_rad_s_[i] = free_velocity[6 + kFirstWheel + static_cast<int>(i)];
  }
  StartDifferential(mass_inverse, body);
  StartStops(mass_inverse, body);
  StartMotors(mass_inverse, wheel_rate_rad_s);
  contact_count_ = 0;
  if (loose_rocks != nullptr) loose_rocks->Start(finder.contacts());
  for (Contact& contact : finder.contacts()) {
    if (contact.gap_m < ContactFinder::kActiveGap_m) {
      LooseRock* rock = loose_rocks != nullptr ? loose_rocks->Find(contact.other) : nullptr;
      StartContact(mass_inverse, finder.part(contact.part), body, rock, contact);
    } else {
      contact.impulse_Ns = {};
      contact.drag_Ns = 0.0;
    }
  }
  for (std::int64_t i = 0; i < iterations_; ++i) Sweep(loose_rocks);
  for (std::size_t i = 0; i < contact_count_; ++i) {
    const ContactRows& rows = contacts_[i];
    rows.contact->impulse_Ns = {rows.normal.impulse, rows.along.impulse, rows.across.impulse};
    rows.contact->drag_Ns = rows.drag.impulse;
  }
  body.AddVelocity(velocity_ - free_velocity);
}

void ConstraintSolver::Start(const DofMatrix& mass_inverse, Row& row) {
  row.response.noalias() = mass_inverse * row.J;
  double diagonal = row.J.dot(row.response) + row.softness;
  if (row.rock != nullptr) {
    diagonal += row.direction_W.head<2>().squaredNorm() / row.rock->mass_kg;
  }
  row.inverse_diagonal = 1.0 / diagonal;
  row.impulse = std::clamp(row.impulse, row.low, row.high);
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
    row.J[6 + joint] = angle_rad > 0.0 ? -1.0 : 1.0;
    row.target = -(room_rad > 0.0 ? 1.0 : kJointRecovery) * room_rad / step_s_;
    row.high = kUnbounded;
    Start(mass_inverse, row);
  }
}

void ConstraintSolver::StartMotors(const DofMatrix& mass_inverse,
                                   const messages::PerWheel<double>& rate_rad_s) {
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    motors_[i].target = rate_rad_s[i];
    Start(mass_inverse, motors_[i]);
  }
}

void ConstraintSolver::StartContact(const DofMatrix& mass_inverse, const Part& part,
                                    const Multibody& body, LooseRock* rock, Contact& contact) {
  if (contact_count_ == contacts_.size()) contacts_.emplace_back();
  ContactRows& rows = contacts_[contact_count_++];
  rows.contact = &contact;
  const bool wheel = part.kind == truth::BodyPart::kWheel;
  const bool wheel_on_soil = wheel && contact.IsSoil();
  rows.normal.rock = rows.along.rock = rows.across.rock = rock;
  rows.normal.direction_W = contact.n_W;
  rows.along.direction_W = contact.along_W;
  rows.across.direction_W = contact.across_W;

  StartNormal(mass_inverse, part, body, wheel_on_soil, rows);

  rows.friction = FrictionOf(part, contact);
  const double spin_rad_s = wheel ? spin_rad_s_[static_cast<std::size_t>(contact.part)] : 0.0;
  const double softness = wheel_on_soil ? SlipSoftness(contact, spin_rad_s) : 0.0;
  body.FillJacobian(part.body, contact.p_W, contact.along_W, rows.along.J);
  body.FillJacobian(part.body, contact.p_W, contact.across_W, rows.across.J);
  rows.along.impulse = contact.impulse_Ns[1];
  rows.across.impulse = contact.impulse_Ns[2];
  for (Row* row : {&rows.along, &rows.across}) {
    row->softness = softness;
    row->low = -kUnbounded;
    row->high = kUnbounded;
    Start(mass_inverse, *row);
  }
  const double load_N = Load_N(contact);
  rows.drag_ratio = wheel_on_soil ? soil_.Resistance_N(load_N) / load_N : 0.0;
  StartDrag(mass_inverse, part, body, rows);
}

// A spring and damper side by side, solved implicitly: force F0 + k (d - d0) - c v at the end of
// the step, with the penetration d. A gap only bounds the approach. The spring of a wheel on soil
// is the soil's sinkage in series with the contact's own, taken along its tangent at the last load
// F0.
void ConstraintSolver::StartNormal(const DofMatrix& mass_inverse, const Part& part,
                                   const Multibody& body, bool wheel_on_soil, ContactRows& rows) {
  const Contact& contact = *rows.contact;
  double k = contact_params_.stiffness_N_m;
  const double c = contact_params_.damping_Ns_m;
  double rest_gap_m = 0.0;  // where the tangent of the spring reaches no force
  if (wheel_on_soil) {
    const double load_N = Load_N(contact);
    const double sinkage_m = soil_.Sinkage_m(load_N);
    const double depth_m = sinkage_m + load_N / k;
    k = 1.0 / (1.0 / soil_.Stiffness_N_m(sinkage_m) + 1.0 / k);
    rest_gap_m = load_N / k - depth_m;
  }
  body.FillJacobian(part.body, contact.p_W, contact.n_W, rows.normal.J);
  rows.normal.target = contact.gap_m > 0.0 ? -contact.gap_m / step_s_
                                           : k * (rest_gap_m - contact.gap_m) / (step_s_ * k + c);
  rows.normal.softness = 1.0 / (step_s_ * (step_s_ * k + c));
  rows.normal.impulse = contact.impulse_Ns[0];
  rows.normal.high = kUnbounded;
  Start(mass_inverse, rows.normal);
}

void ConstraintSolver::StartDrag(const DofMatrix& mass_inverse, const Part& part,
                                 const Multibody& body, ContactRows& rows) {
  rows.drag.impulse = rows.contact->drag_Ns;
  if (rows.drag_ratio == 0.0) return;
  // Acts on the axle, so that the wheel has to pull it by traction.
  body.FillJacobian(body.Parent(part.body), body.X_WB(part.body).translation(),
                    rows.contact->along_W, rows.drag.J);
  rows.drag.low = -kUnbounded;
  rows.drag.high = kUnbounded;
  Start(mass_inverse, rows.drag);
}

// Implicit viscous slip: slip velocity |omega r| s(tau) at the share tau of the largest traction,
// with tau from the last step's impulses, written as softness of the friction rows.
double ConstraintSolver::SlipSoftness(const Contact& contact, double spin_rad_s) const {
  const double load_N = Load_N(contact);
  const double most_Ns = soil_.LargestTraction_N(load_N) * step_s_;
  if (most_Ns <= 0.0) return 0.0;
  const double tau =
      std::min(std::hypot(contact.impulse_Ns[1], contact.impulse_Ns[2]) / most_Ns, 1.0);
  return std::abs(spin_rad_s) * wheel_radius_m_ * soil_.SlipPerShare(tau, load_N) / most_Ns;
}

double ConstraintSolver::Load_N(const Contact& contact) const {
  return std::max(contact.impulse_Ns[0] / step_s_, kLeastLoad_N);
}

double ConstraintSolver::FrictionOf(const Part& part, const Contact& contact) const {
  if (part.kind != truth::BodyPart::kWheel) return contact_params_.body_rock_friction;
  if (!contact.IsSoil()) return contact_params_.wheel_rock_friction;
  const double load_N = Load_N(contact);
  return soil_.LargestTraction_N(load_N) / load_N;
}

void ConstraintSolver::Sweep(LooseRocks* loose_rocks) {
  Relax(differential_);
  for (Row& row : stops_) {
    if (row.high > 0.0) Relax(row);
  }
  for (Row& row : motors_) Relax(row);
  for (std::size_t i = 0; i < contact_count_; ++i) {
    ContactRows& rows = contacts_[i];
    Relax(rows.normal);
    RelaxFriction(rows);
    if (rows.drag_ratio > 0.0) {
      rows.drag.high = rows.drag_ratio * rows.normal.impulse;
      rows.drag.low = -rows.drag.high;
      Relax(rows.drag);
    }
  }
  if (loose_rocks != nullptr) loose_rocks->Hold();
}

double ConstraintSolver::Wanted(const Row& row) const {
  double error = row.target - row.J.dot(velocity_) - row.softness * row.impulse;
  if (row.rock != nullptr) error += row.direction_W.dot(row.rock->v_W_m_s);
  return row.impulse + error * row.inverse_diagonal;
}

void ConstraintSolver::Apply(double impulse, Row& row) {
  velocity_ += (impulse - row.impulse) * row.response;
  if (row.rock != nullptr) row.rock->PushBack((impulse - row.impulse) * row.direction_W);
  row.impulse = impulse;
}

void ConstraintSolver::Relax(Row& row) { Apply(std::clamp(Wanted(row), row.low, row.high), row); }

// Both friction rows from the same velocities, then back onto the cone. (One after the other, the
// second row would take back the yaw that the first one causes, and a sliding wheel would keep
// part of its cone for a sideways force that nothing asks for.)
void ConstraintSolver::RelaxFriction(ContactRows& rows) {
  const double along = Wanted(rows.along);
  const double across = Wanted(rows.across);
  const double most_Ns = rows.friction * rows.normal.impulse;
  const double size_Ns = std::hypot(along, across);
  const double scale = size_Ns > most_Ns ? most_Ns / size_Ns : 1.0;
  Apply(scale * along, rows.along);
  Apply(scale * across, rows.across);
}

}  // namespace rockyard::rover
