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
constexpr double kConverged = 1e-4;

}  // namespace

ConstraintSolver::ConstraintSolver(const RoverParams& params, const terrain::SoilParams& soil)
    : laws_(params, soil),
      stall_torque_Nm_(params.drive.stall_torque_Nm),
      iterations_(params.physics.solver_iterations),
      wheel_radius_m_(params.geometry.wheel_radius_m),
      mean_load_N_(params.mass.total_kg * params.physics.gravity_m_s2 / messages::kWheelCount),
      sinkage_(soil, laws_.soil(), params.geometry.wheel_radius_m, mean_load_N_),
      step_s_(params.physics.step_s) {
  differential_.Unbind();
  for (std::size_t i = 0; i < kStops; ++i) {
    const bool rocker = i <= static_cast<std::size_t>(kRightRocker);
    stop_angle_rad_[i] =
        rocker ? params.geometry.rocker_limit_rad : params.geometry.bogie_limit_rad;
  }
  for (Bounds& motor : motors_) {
    motor.high = stall_torque_Nm_ * step_s_;
    motor.low = -motor.high;
  }
}

void ConstraintSolver::Clear() {
  differential_.impulse = 0.0;
  for (Bounds& stop : stops_) stop.impulse = 0.0;
  // The contacts' impulses are forgotten with the contacts.
  for (Bounds& motor : motors_) motor.impulse = 0.0;
  sinkage_.Clear();
  slip_.fill(0.0);
}

// Every row starts from its last impulse, then the sweeps go through joints, motors and contacts.
// Records depend on this order of the rows.
void ConstraintSolver::Solve(const Step& step, LooseRocks* loose_rocks, ContactFinder& finder,
                             Multibody& body) {
  const JointSpaceInertia& inertia = step.inertia;
  if (step.duration_s != step_s_) SetStep(step.duration_s, loose_rocks, finder);
  const DofVector free_velocity = body.Velocity();
  velocity_ = inertia.ToUnit(free_velocity);
  DofVector before = step.before;
  // A motor that held its rate begins the step at the rate that its ramp says; a stalled motor
  // begins at the rate that it has.
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const Bounds& motor = motors_[i];
    double& rate_rad_s = before[6 + kFirstWheel + static_cast<int>(i)];
    if (motor.low < motor.impulse && motor.impulse < motor.high) rate_rad_s = step.rates.from[i];
    rim_before_m_s_[i] = std::abs(rate_rad_s) * wheel_radius_m_;
  }
  unit_before_ = inertia.ToUnit(before);
  StartDifferential(inertia, body);
  StartStops(inertia, body);
  StartMotors(inertia, step.rates.to);
  contact_count_ = 0;
  MarkActive(body, finder);
  if (loose_rocks != nullptr) loose_rocks->Start(finder.contacts());
  for (Contact& contact : finder.contacts()) {
    if (contact.active) {
      LooseRock* rock = loose_rocks != nullptr ? loose_rocks->Find(contact.other) : nullptr;
      StartContact(inertia, finder.part(contact.part), body, rock, contact);
    } else {
      contact.Forget();
    }
  }
  for (std::size_t i = 0; i < contact_count_; ++i) contacts_[i].Follow(laws_, velocity_);
  // Braked wheels get all sweeps: what sweeps leave open would let them creep.
  const bool driven = std::any_of(step.rates.to.begin(), step.rates.to.end(),
                                  [](double rate) { return rate != 0.0; });
  const double enough_Ns = driven ? kConverged * mean_load_N_ * step_s_ : 0.0;
  for (std::int64_t i = 0; i < iterations_ * step.patience; ++i) {
    if (Sweep(loose_rocks) < enough_Ns) break;
  }
  for (std::size_t i = 0; i < contact_count_; ++i) contacts_[i].Keep();
  const DofVector velocity = inertia.FromUnit(velocity_);
  if (sinkage_.enabled()) Dig(before, velocity, inertia);
  body.AddVelocity(velocity - free_velocity);
}

void ConstraintSolver::SetStep(double step_s, LooseRocks* loose_rocks, ContactFinder& finder) {
  const double ratio = step_s / step_s_;
  step_s_ = step_s;
  differential_.impulse *= ratio;
  for (Bounds& stop : stops_) stop.impulse *= ratio;
  for (Bounds& motor : motors_) {
    motor.impulse *= ratio;
    motor.high = stall_torque_Nm_ * step_s;
    motor.low = -motor.high;
  }
  finder.ScaleImpulses(ratio);
  if (loose_rocks != nullptr) loose_rocks->SetStep(step_s);
}

// The differential bar turns one rocker back by what the other turns: sum of the rates 0.
void ConstraintSolver::StartDifferential(const JointSpaceInertia& inertia, const Multibody& body) {
  const double error_rad = body.JointAngle(kLeftRocker) + body.JointAngle(kRightRocker);
  differential_.target = -kJointRecovery * error_rad / step_s_;
  rockers_ = {inertia.OfJoint(kLeftRocker), inertia.OfJoint(kRightRocker)};
  differential_.per_diagonal =
      1.0 / (rockers_[0].Yield() + rockers_[1].Yield() +
             2.0 * rockers_[0].part.head<6>().dot(rockers_[1].part.head<6>()));
  // Warm start: the impulse of the last step acts at once.
  for (const UnitRow& row : rockers_) row.Push(differential_.impulse, velocity_);
}

void ConstraintSolver::StartStops(const JointSpaceInertia& inertia, const Multibody& body) {
  for (std::size_t i = 0; i < kStops; ++i) {
    Bounds& stop = stops_[i];
    const int joint = static_cast<int>(i);
    const double angle_rad = body.JointAngle(joint);
    const double room_rad = stop_angle_rad_[i] - std::abs(angle_rad);
    if (room_rad > kStopWatch_rad) {
      stop.high = stop.impulse = 0.0;
      continue;
    }
    // J v is the rate away from the stop. It must not use up the room within the step,
    // J v >= -room / h; beyond the stop (room < 0) the share kJointRecovery is taken back.
    stop_sign_[i] = angle_rad > 0.0 ? -1.0 : 1.0;
    stop.target = -(room_rad > 0.0 ? 1.0 : kJointRecovery) * room_rad / step_s_;
    stop.high = Bounds::kUnbounded;
    stop_rows_[i] = inertia.OfJoint(joint);
    stop.per_diagonal = 1.0 / stop_rows_[i].Yield();
    stop_rows_[i].Push(stop_sign_[i] * stop.impulse, velocity_);
  }
}

void ConstraintSolver::StartMotors(const JointSpaceInertia& inertia,
                                   const messages::PerWheel<double>& rate_rad_s) {
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    // A motor holds its rate up to the stall torque: |p| <= torque h.
    motors_[i].target = rate_rad_s[i];
    touches_[i] = false;
    motor_rows_[i] = inertia.OfJoint(kFirstWheel + static_cast<int>(i));
    motors_[i].per_diagonal = 1.0 / motor_rows_[i].Yield();
    motor_rows_[i].Push(motors_[i].impulse, velocity_);
  }
}

void ConstraintSolver::MarkActive(const Multibody& body, ContactFinder& finder) const {
  const DofVector& velocity = body.Velocity();
  DofVector J;
  for (Contact& contact : finder.contacts()) {
    contact.active = contact.gap_m < kActiveGap_m;
    if (contact.active) continue;
    body.FillJacobian(finder.part(contact.part).body, contact.p_W, contact.n_W, J);
    // Gap at the end of the step if the motion went on without contacts.
    contact.active = contact.gap_m + step_s_ * J.dot(velocity) < kActiveGap_m;
  }
}

void ConstraintSolver::StartContact(const JointSpaceInertia& inertia, const Part& part,
                                    const Multibody& body, LooseRock* rock, Contact& contact) {
  if (contact_count_ == contacts_.size()) contacts_.emplace_back();
  ContactBlock& block = contacts_[contact_count_++];
  // Laws are those at the loads of the last step, and at the slip that wheels will have dug in for
  // midway, fixed within this one.
  const bool wheel = part.kind == truth::BodyPart::kWheel;
  const auto index = static_cast<std::size_t>(contact.part);
  const ContactLaw law = laws_.Of(part, contact, step_s_, wheel ? DugSlip(index) : 0.0);
  block.Start({inertia, body, part, laws_.damping_Ns_m(), step_s_}, law, rock, contact, velocity_);
  if (!wheel) return;
  touches_[index] = true;
  block.AddMotor(motor_rows_[index], motors_[index], wheel_radius_m_, unit_before_);
}

double ConstraintSolver::DugSlip(std::size_t wheel) const {
  if (!sinkage_.enabled()) return 0.0;
  return sinkage_.After(wheel, slip_[wheel], 0.5 * step_s_ * rim_before_m_s_[wheel]);
}

// Wheels dig by their mean slip over the step; a wheel that turns off the soil has no slip and
// leaves its hole.
void ConstraintSolver::Dig(const DofVector& before, const DofVector& after,
                           const JointSpaceInertia& inertia) {
  const DofVector mean = 0.5 * (before + after);
  const UnitVelocity unit_mean = inertia.ToUnit(mean);
  messages::PerWheel<double> slip_m_s{};
  for (std::size_t i = 0; i < contact_count_; ++i) {
    const ContactBlock& block = contacts_[i];
    const double speed_m_s = block.SlipSpeed_m_s(unit_mean);
    if (speed_m_s == 0.0) continue;
    double& largest_m_s = slip_m_s[block.part()];
    largest_m_s = std::max(largest_m_s, speed_m_s);
  }
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const double rim_m_s = std::abs(mean[6 + kFirstWheel + static_cast<int>(i)]) * wheel_radius_m_;
    slip_[i] = rim_m_s > 0.0 ? slip_m_s[i] / rim_m_s : 0.0;
    if (rim_m_s > 0.0) sinkage_.Roll(i, slip_[i], rim_m_s * step_s_);
  }
}

double ConstraintSolver::Sweep(LooseRocks* loose_rocks) {
  double largest_Ns = RelaxDifferential();
  // A stop that is not watched has the upper bound 0.
  for (std::size_t i = 0; i < kStops; ++i) {
    if (stops_[i].high == 0.0) continue;
    largest_Ns = std::max(largest_Ns, Relax(stop_sign_[i], stop_rows_[i], stops_[i]));
  }
  // The motor of a wheel that touches something is solved with its friction.
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    if (!touches_[i]) largest_Ns = std::max(largest_Ns, Relax(1.0, motor_rows_[i], motors_[i]));
  }
  for (std::size_t i = 0; i < contact_count_; ++i) {
    largest_Ns = std::max(largest_Ns, contacts_[i].Relax(laws_, velocity_));
  }
  if (loose_rocks != nullptr) loose_rocks->Hold();
  return largest_Ns;
}

double ConstraintSolver::RelaxDifferential() {
  const double rate_rad_s = rockers_[0].Velocity(velocity_) + rockers_[1].Velocity(velocity_);
  const double impulse = differential_.Wanted(rate_rad_s);
  const double change = impulse - differential_.impulse;
  for (const UnitRow& row : rockers_) row.Push(change, velocity_);
  differential_.impulse = impulse;
  return std::abs(change);
}

double ConstraintSolver::Relax(double sign, const UnitRow& row, Bounds& bounds) {
  const double impulse = bounds.Wanted(sign * row.Velocity(velocity_));
  const double change = impulse - bounds.impulse;
  row.Push(sign * change, velocity_);
  bounds.impulse = impulse;
  return std::abs(change);
}

}  // namespace rockyard::rover
