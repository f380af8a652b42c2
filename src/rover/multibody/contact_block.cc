#include "rover/multibody/contact_block.h"

#include <algorithm>
#include <cmath>

namespace rockyard::rover {

namespace {

// Returns what a unit impulse of one row does to the velocity of another of the same contact.
double Coupling(const UnitRow& a, const UnitRow& b) {
  return a.part.dot(b.part) + a.of_wheel * b.of_wheel;
}

}  // namespace

void ContactBlock::Start(const ContactStart& start, const ContactLaw& law, LooseRock* rock,
                         Contact& contact, UnitVelocity& z) {
  contact_ = &contact;
  rock_ = rock;
  law_ = law;
  motor_ = nullptr;
  slip_ = {};
  along_target_m_s_ = across_target_m_s_ = softness_ = 0.0;
  const auto row = [&](int body, const math::Vector3& p_W, const math::Vector3& n_W) {
    return start.inertia.OfPoint(start.body, body, p_W, n_W);
  };
  normal_row_ = row(start.part.body, contact.p_W, contact.n_W);
  along_row_ = row(start.part.body, contact.p_W, contact.along_W);
  across_row_ = row(start.part.body, contact.p_W, contact.across_W);
  // Motion resistance acts on the axle, so that the wheel has to overcome it by traction.
  drag_row_ = law.drag_ratio == 0.0
                  ? UnitRow{}
                  : row(start.body.Parent(start.part.body),
                        start.body.X_WB(start.part.body).translation(), contact.along_W);
  motor_row_ = {};
  along_motor_ = across_motor_ = drag_motor_ = normal_motor_ = 0.0;
  Couple();
  StartNormal(start);
  along_Ns_ = contact.impulse_Ns[1];
  across_Ns_ = contact.impulse_Ns[2];
  drag_.impulse = contact.drag_Ns;
  drag_.per_diagonal = 1.0 / drag_row_.Yield();
  side_face_.impulse = contact.side_Ns;
  side_face_.per_diagonal = 1.0 / friction_.a1();
  WarmStart(z);
}

// A spring and damper side by side, solved implicitly: with the separating speed v at the end of
// the step h, penetration d - h v and force F = k (d - h v - d_0) - c v. With F = p / h this is the
// row
//   v + p / (h (h k + c)) = k (d - d_0) / (h k + c),   p >= 0.
// A contact with a gap g > 0 only bounds the approach, v >= -g / h, with the same softness.
void ContactBlock::StartNormal(const ContactStart& start) {
  const double h = start.step_s;
  const double k = law_.stiffness_N_m;
  const double c = start.damping_Ns_m;
  normal_.target = contact_->gap_m > 0.0 ? -contact_->gap_m / h
                                         : -k * (law_.rest_depth_m + contact_->gap_m) / (h * k + c);
  normal_.softness = 1.0 / (h * (h * k + c));
  double yield = normal_row_.Yield() + normal_.softness;
  if (rock_ != nullptr) yield += contact_->n_W.head<2>().squaredNorm() / rock_->mass_kg;
  normal_.per_diagonal = 1.0 / yield;
  normal_.high = Bounds::kUnbounded;
  normal_.impulse = std::max(contact_->impulse_Ns[0], 0.0);
}

void ContactBlock::Couple() {
  normal_along_ = Coupling(normal_row_, along_row_);
  normal_across_ = Coupling(normal_row_, across_row_);
  normal_drag_ = Coupling(normal_row_, drag_row_);
  along_drag_ = Coupling(along_row_, drag_row_);
  across_drag_ = Coupling(across_row_, drag_row_);
  double along = along_row_.Yield();
  double across = across_row_.Yield();
  double along_across = Coupling(along_row_, across_row_);
  if (rock_ != nullptr) {
    // A rock of mass m that yields horizontally: rows along e and f change each other's velocity
    // against it by e . f / m.
    const auto of_rock = [this](const math::Vector3& e, const math::Vector3& f) {
      return e.head<2>().dot(f.head<2>()) / rock_->mass_kg;
    };
    normal_along_ += of_rock(contact_->n_W, contact_->along_W);
    normal_across_ += of_rock(contact_->n_W, contact_->across_W);
    along += of_rock(contact_->along_W, contact_->along_W);
    across += of_rock(contact_->across_W, contact_->across_W);
    along_across += of_rock(contact_->along_W, contact_->across_W);
  }
  friction_.Set(along, across, along_across);
}

// The impulses of the last step act at once.
void ContactBlock::WarmStart(UnitVelocity& z) {
  const double side_Ns = law_.side_ratio != 0.0 ? side_face_.impulse : 0.0;
  Act({.normal = normal_.impulse,
       .along = along_Ns_,
       .across = across_Ns_ + side_Ns,
       .drag = law_.drag_ratio != 0.0 ? drag_.impulse : 0.0},
      z);
}

ContactBlock::Rows ContactBlock::Velocities(const UnitVelocity& z) const {
  const Vector8 part = z.Of(normal_row_.side);
  const double wheel = z.wheels[normal_row_.wheel];
  const auto of = [&](const UnitRow& row) { return row.part.dot(part) + row.of_wheel * wheel; };
  Rows velocity{of(normal_row_), of(along_row_), of(across_row_), of(drag_row_), of(motor_row_)};
  if (rock_ != nullptr) {
    // A row sees the motion against the rock.
    velocity.normal -= contact_->n_W.dot(rock_->v_W_m_s);
    velocity.along -= contact_->along_W.dot(rock_->v_W_m_s);
    velocity.across -= contact_->across_W.dot(rock_->v_W_m_s);
  }
  return velocity;
}

// Lets impulses act on rover and rock.
void ContactBlock::Act(const Rows& change, UnitVelocity& z) {
  const auto push = [&change](const auto& normal, const auto& along, const auto& across,
                              const auto& drag, const auto& motor) {
    return (change.normal * normal + (change.along * along + change.across * across)) +
           (change.drag * drag + change.motor * motor);
  };
  z.Set(normal_row_.side,
        z.Of(normal_row_.side) + push(normal_row_.part, along_row_.part, across_row_.part,
                                      drag_row_.part, motor_row_.part));
  z.wheels[normal_row_.wheel] +=
      push(normal_row_.of_wheel, along_row_.of_wheel, across_row_.of_wheel, drag_row_.of_wheel,
           motor_row_.of_wheel);
  if (rock_ == nullptr) return;
  rock_->PushBack(change.normal * contact_->n_W + change.along * contact_->along_W +
                  change.across * contact_->across_W);
}

void ContactBlock::AddMotor(const UnitRow& row, Bounds& motor, double wheel_radius_m,
                            const UnitVelocity& before) {
  motor_ = &motor;
  wheel_radius_m_ = wheel_radius_m;
  motor_row_ = row;
  normal_motor_ = Coupling(normal_row_, row);
  along_motor_ = Coupling(along_row_, row);
  across_motor_ = Coupling(across_row_, row);
  drag_motor_ = Coupling(drag_row_, row);
  // While the motor holds, its impulse undoes what friction does to the wheel's rate: A - g g' / d.
  const double g0 = along_motor_;
  const double g1 = across_motor_;
  const double d = motor_yield_ = row.Yield();
  const FrictionBlock& A = friction_;
  driven_friction_.Set(A.a0() - g0 * g0 / d, A.a1() - g1 * g1 / d, A.a01() - g0 * g1 / d);
  if (!law_.slips) return;
  const Rows velocity = Velocities(before);
  slip_from_ = {std::abs(velocity.motor) * wheel_radius_m, {velocity.along, velocity.across}};
}

void ContactBlock::Follow(const ContactLaws& laws, const UnitVelocity& z) {
  if (law_.slips) FollowSlip(laws, Velocities(z));
}

void ContactBlock::Keep() const {
  contact_->impulse_Ns = {normal_.impulse, along_Ns_, across_Ns_};
  contact_->drag_Ns = drag_.impulse;
  contact_->side_Ns = side_face_.impulse;
}

double ContactBlock::SlipSpeed_m_s(const UnitVelocity& z) const {
  if (!law_.slips || normal_.impulse <= 0.0) return 0.0;
  const Rows velocity = Velocities(z);
  return std::sqrt(velocity.along * velocity.along + velocity.across * velocity.across);
}

double ContactBlock::Relax(const ContactLaws& laws, UnitVelocity& z) {
  Rows velocity = Velocities(z);
  Rows change;
  // Friction after the normal: its bound is that of the normal impulse of this sweep.
  const double normal_Ns = normal_.Wanted(velocity.normal);
  change.normal = normal_Ns - normal_.impulse;
  normal_.impulse = normal_Ns;
  velocity.along += change.normal * normal_along_;
  velocity.across += change.normal * normal_across_;
  velocity.drag += change.normal * normal_drag_;
  velocity.motor += change.normal * normal_motor_;

  const Rows friction = motor_ != nullptr ? DrivenFriction(velocity) : Friction(velocity);
  change.along = friction.along - along_Ns_;
  change.across = friction.across - across_Ns_;
  along_Ns_ = friction.along;
  across_Ns_ = friction.across;
  velocity.along += change.along * friction_.a0() + change.across * friction_.a01();
  velocity.across += change.along * friction_.a01() + change.across * friction_.a1();
  double largest_Ns =
      std::max(std::abs(change.normal), std::max(std::abs(change.along), std::abs(change.across)));
  if (motor_ != nullptr) {
    change.motor = friction.motor - motor_->impulse;
    motor_->impulse = friction.motor;
    velocity.along += change.motor * along_motor_;
    velocity.across += change.motor * across_motor_;
    velocity.drag += change.motor * drag_motor_;
    velocity.motor +=
        change.motor * motor_yield_ + change.along * along_motor_ + change.across * across_motor_;
    largest_Ns = std::max(largest_Ns, std::abs(change.motor));
  }
  // |p_drag| <= (R / N) p_n, |p_side| <= (B / N) p_n. The soil at the side face of a wheel holds it
  // until its own bound is reached, beside the friction.
  if (law_.drag_ratio > 0.0) {
    velocity.drag += change.along * along_drag_ + change.across * across_drag_;
    const double drag_Ns = drag_.WantedWithin(law_.drag_ratio * normal_Ns, velocity.drag);
    change.drag = drag_Ns - drag_.impulse;
    drag_.impulse = drag_Ns;
    velocity.along += change.drag * along_drag_;
    velocity.across += change.drag * across_drag_;
    velocity.motor += change.drag * drag_motor_;
    largest_Ns = std::max(largest_Ns, std::abs(change.drag));
  }
  if (law_.side_ratio > 0.0) {
    const double side_Ns = side_face_.WantedWithin(law_.side_ratio * normal_Ns, velocity.across);
    const double side_change_Ns = side_Ns - side_face_.impulse;
    side_face_.impulse = side_Ns;
    change.across += side_change_Ns;
    velocity.along += side_change_Ns * friction_.a01();
    velocity.across += side_change_Ns * friction_.a1();
    velocity.motor += side_change_Ns * across_motor_;
    largest_Ns = std::max(largest_Ns, std::abs(side_change_Ns));
  }
  Act(change, z);
  if (law_.slips) FollowSlip(laws, velocity);
  return largest_Ns;
}

// theta v_1 + (1 - theta) v_0 + c p = 0, divided by theta, is a row for v_1.
void ContactBlock::FollowSlip(const ContactLaws& laws, const Rows& velocity) {
  const WheelSlip slip{std::abs(velocity.motor) * wheel_radius_m_,
                       {velocity.along, velocity.across}};
  slip_ = laws.StepOfSlip(law_, {slip_from_, slip}, slip_.theta);
  const double share = 1.0 - slip_.per_theta;  // -(1 - theta) / theta
  along_target_m_s_ = share * slip_from_.v_m_s.x();
  across_target_m_s_ = share * slip_from_.v_m_s.y();
  softness_ = slip_.softness_m_per_Ns * slip_.per_theta;
  (motor_ != nullptr ? driven_friction_ : friction_).Expect(softness_);
}

// Returns the right side b of the block of both friction rows: what remains without the impulses p
// of these rows. `lack` is what the rows lack to their targets, softness left out: b = lack + A p.
std::array<double, 2> ContactBlock::RightSide(const FrictionBlock& block, double lack_along_m_s,
                                              double lack_across_m_s) const {
  return {lack_along_m_s + block.a0() * along_Ns_ + block.a01() * across_Ns_,
          lack_across_m_s + block.a01() * along_Ns_ + block.a1() * across_Ns_};
}

ContactBlock::Rows ContactBlock::Friction(const Rows& velocity) {
  const auto p = friction_.Solve(RightSide(friction_, along_target_m_s_ - velocity.along,
                                           across_target_m_s_ - velocity.across),
                                 softness_, law_.friction * normal_.impulse);
  return {.along = p[0], .across = p[1]};
}

// Solves the motor of a wheel and the friction at its contact together. Solved one after the other,
// each would undo what the other did to the light wheel, and the heavy rover between them would
// take some hundred sweeps to move.
ContactBlock::Rows ContactBlock::DrivenFriction(const Rows& velocity) {
  const Bounds& motor = *motor_;
  const double most_Ns = law_.friction * normal_.impulse;
  const double along_m_s = along_target_m_s_ - velocity.along;
  const double across_m_s = across_target_m_s_ - velocity.across;
  // The motor holds its rate: its impulse changes by dq = (lack of its row - g . dp) / d.
  const double hold_Ns = (motor.target - velocity.motor) * motor.per_diagonal;
  auto p = driven_friction_.Solve(RightSide(driven_friction_, along_m_s - hold_Ns * along_motor_,
                                            across_m_s - hold_Ns * across_motor_),
                                  softness_, most_Ns);
  double q = motor.impulse + hold_Ns -
             (along_motor_ * (p[0] - along_Ns_) + across_motor_ * (p[1] - across_Ns_)) *
                 motor.per_diagonal;
  if (q < motor.low || q > motor.high) {
    // The motor stalls: its torque is given, and friction alone decides how the wheel turns.
    q = std::clamp(q, motor.low, motor.high);
    const double change = q - motor.impulse;
    p = friction_.Solve(RightSide(friction_, along_m_s - change * along_motor_,
                                  across_m_s - change * across_motor_),
                        softness_, most_Ns);
  }
  return {.along = p[0], .across = p[1], .motor = q};
}

}  // namespace rockyard::rover
