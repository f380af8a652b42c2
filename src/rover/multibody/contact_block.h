// The rows of one contact: normal, friction with slip and motor, motion resistance, side face. The
// constraint solver relaxes them together, contact by contact. Records depend on the order within.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "rover/multibody/contact_finder.h"
#include "rover/multibody/contact_law.h"
#include "rover/multibody/joint_space_inertia.h"
#include "rover/multibody/loose_rocks.h"

namespace rockyard::rover {

// One scalar constraint: J v + softness * impulse = target, impulse within [low, high].
struct Bounds {
  double target = 0.0;
  double softness = 0.0;
  double per_diagonal = 1.0;  // one over the change of the left side per unit impulse
  double impulse = 0.0;
  double low = 0.0;
  double high = 0.0;

  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  void Unbind() {
    low = -kUnbounded;
    high = kUnbounded;
  }
  // Returns the impulse that makes the row exact with all others as they are, within its bounds;
  // velocity: J v of the moment.
  double Wanted(double velocity) const {
    const double free = impulse + (target - velocity - softness * impulse) * per_diagonal;
    return std::min(std::max(free, low), high);
  }
  // Likewise where the bounds are those of another row.
  double WantedWithin(double most, double velocity) const {
    return std::min(std::max(impulse - velocity * per_diagonal, -most), most);
  }
};

// What a step knows of a contact before its first sweep.
struct ContactStart {
  const JointSpaceInertia& inertia;
  const Multibody& body;
  const Part& part;
  double damping_Ns_m;
  double step_s;
};

// The contact's constraints in one step. Keep one block for each contact from Start to Keep.
class ContactBlock {
 public:
  // Makes the rows and lets the impulses of the last step act on z. rock: null where it is fixed.
  void Start(const ContactStart& start, const ContactLaw& law, LooseRock* rock, Contact& contact,
             UnitVelocity& z);
  // Lets the motor of a wheel take part; `before`: velocities at the beginning of the step.
  void AddMotor(const UnitRow& row, Bounds& motor, double wheel_radius_m,
                const UnitVelocity& before);

  // Sets the friction rows by the slip of a rover that moves with z. Called before the first Relax.
  void Follow(const ContactLaws& laws, const UnitVelocity& z);
  // Solves row by row for the impulses, which act on z and on the rock, and follows the slip that
  // is left, for the next sweep: a processor does that while it solves the next contact. Returns
  // the largest change of an impulse, N s or N m s of the motor.
  double Relax(const ContactLaws& laws, UnitVelocity& z);

  // Leaves the impulses in the contact, for the next step.
  void Keep() const;
  // Returns the slip of a wheel on soil that moves with z, m/s; 0 for all other contacts, and where
  // none is pressed.
  double SlipSpeed_m_s(const UnitVelocity& z) const;
  std::size_t part() const { return static_cast<std::size_t>(contact_->part); }

 private:
  // Velocities of the rows, or impulses.
  struct Rows {
    double normal = 0.0;
    double along = 0.0;
    double across = 0.0;
    double drag = 0.0;
    double motor = 0.0;
  };

  void StartNormal(const ContactStart& start);
  void Couple();
  void WarmStart(UnitVelocity& z);
  [[gnu::always_inline]] inline Rows Velocities(const UnitVelocity& z) const;
  [[gnu::always_inline]] inline void Act(const Rows& change, UnitVelocity& z);
  [[gnu::always_inline]] inline void FollowSlip(const ContactLaws& laws, const Rows& velocity);
  // Return the impulses of the friction rows, of a wheel with that of its motor; velocity: as they
  // are before.
  [[gnu::always_inline]] inline Rows Friction(const Rows& velocity);
  [[gnu::always_inline]] inline Rows DrivenFriction(const Rows& velocity);
  std::array<double, 2> RightSide(const FrictionBlock& block, double lack_along_m_s,
                                  double lack_across_m_s) const;

  Contact* contact_ = nullptr;
  LooseRock* rock_ = nullptr;
  ContactLaw law_;
  UnitRow normal_row_, along_row_, across_row_, drag_row_, motor_row_;
  // What a unit impulse of one row does to the velocity of another.
  double normal_along_ = 0.0, normal_across_ = 0.0, normal_drag_ = 0.0, normal_motor_ = 0.0;
  double along_drag_ = 0.0, across_drag_ = 0.0;
  double along_motor_ = 0.0, across_motor_ = 0.0, drag_motor_ = 0.0, motor_yield_ = 0.0;
  Bounds normal_;
  double along_Ns_ = 0.0;
  double across_Ns_ = 0.0;
  Bounds drag_;
  Bounds side_face_;  // sees the row across
  FrictionBlock friction_;
  Bounds* motor_ = nullptr;        // of the wheel; null for other parts
  FrictionBlock driven_friction_;  // `friction_` while the motor holds its rate
  double wheel_radius_m_ = 0.0;
  WheelSlip slip_from_;  // at the beginning of the step
  SlipStep slip_;        // after the last sweep
  double along_target_m_s_ = 0.0;
  double across_target_m_s_ = 0.0;
  double softness_ = 0.0;  // of the friction
};

}  // namespace rockyard::rover
