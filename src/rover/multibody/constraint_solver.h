// Velocity constraints of one step of RockerBogie: differential, joint stops, motors, contacts with
// friction, slip and motion resistance. They are solved by projected Gauss-Seidel, started from the
// impulses of the last step. Records depend on the order of the rows in a sweep (differential,
// stops, motors of wheels without a contact, contact by contact) and on the impulses that it starts
// from, as the number of sweeps is bounded.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "messages/wheels.h"
#include "rover/motor_ramp.h"
#include "rover/multibody/contact_finder.h"
#include "rover/multibody/contact_law.h"
#include "rover/multibody/loose_rocks.h"
#include "rover/multibody/multibody.h"
#include "rover/rover_params.h"
#include "rover/wheel_soil.h"
#include "terrain/soil_params.h"

namespace rockyard::rover {

// Solves all constraints of one step together, after Bullet has accelerated the free rover. The
// table in src/rover/README.md lists the rows.
class ConstraintSolver {
 public:
  ConstraintSolver(const RoverParams& params, const terrain::SoilParams& soil);

  // Forgets the impulses of the last step, and how far wheels have dug in.
  void Clear();

  // What a step begins with.
  struct Step {
    const DofMatrix& mass_inverse;
    const DofVector& before;  // velocities before gravity accelerated the body
    const MotorRates& rates;  // told to the wheels' motors
    double duration_s;
  };

  // Changes the velocities of `body`, already accelerated by gravity, so that they keep all
  // constraints. Leaves the impulses in the contacts. Rocks are fixed where loose_rocks is null.
  void Solve(const Step& step, LooseRocks* loose_rocks, ContactFinder& finder, Multibody& body);

  // Returns the length of the last step.
  double step_s() const { return step_s_; }
  // Returns the mean torque of a wheel's motor over the last step.
  double MotorTorque_Nm(std::size_t wheel) const { return motors_[wheel].impulse / step_s_; }

 private:
  // One scalar constraint: J v + softness * impulse = target, impulse within [low, high].
  struct Row {
    DofVector J = DofVector::Zero();
    DofVector response = DofVector::Zero();  // velocity change per unit impulse
    double target = 0.0;
    double softness = 0.0;
    double diagonal = 0.0;  // change of the left side per unit impulse
    double impulse = 0.0;
    double low = 0.0;
    double high = 0.0;
    // A row against a rock that may slide also sees that rock's velocity along its direction.
    LooseRock* rock = nullptr;
    math::Vector3 direction_W = math::Vector3::Zero();

    void Unbind() {
      low = -kUnbounded;
      high = kUnbounded;
    }
  };
  // The rows of one contact.
  struct ContactRows {
    Contact* contact = nullptr;
    ContactLaw law;
    Row normal, along, across, drag, side;
    FrictionBlock friction;  // of along and across, without the softness of the slip
    SlipStep slip;           // in the last sweep
    WheelSlip slip_from;     // at the beginning of the step
    Row* motor = nullptr;    // of the wheel; null for other parts
    // What a unit impulse of the motor does to the velocity of the contact.
    Eigen::Vector2d motor_coupling = Eigen::Vector2d::Zero();
    FrictionBlock driven_friction;  // `friction` while the motor holds its rate
  };
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  static constexpr std::size_t kStops = 4;  // rockers and bogies

  // Scales the impulses of a step of another length, from which this step starts.
  void SetStep(double step_s, LooseRocks* loose_rocks, ContactFinder& finder);
  // Completes a row whose J, target, softness and impulse are set, and applies the impulse.
  void Start(const DofMatrix& mass_inverse, Row& row);
  void StartDifferential(const DofMatrix& mass_inverse, const Multibody& body);
  void StartStops(const DofMatrix& mass_inverse, const Multibody& body);
  void StartMotors(const DofMatrix& mass_inverse, const messages::PerWheel<double>& rate_rad_s);
  void MarkActive(const Multibody& body, ContactFinder& finder) const;
  void StartContact(const DofMatrix& mass_inverse, const Part& part, const Multibody& body,
                    LooseRock* rock, Contact& contact);
  void StartNormal(const DofMatrix& mass_inverse, const Part& part, const Multibody& body,
                   ContactRows& rows);
  void StartFriction(const DofMatrix& mass_inverse, const Part& part, const Multibody& body,
                     ContactRows& rows);
  void StartDrag(const DofMatrix& mass_inverse, const Part& part, const Multibody& body,
                 ContactRows& rows);
  void StartSide(ContactRows& rows);
  void KeepForNextStep(const ContactRows& rows) const;
  double DugSlip(std::size_t wheel) const;
  double RimSpeed(std::size_t wheel, const DofVector& velocity) const;
  void Dig();

  // Makes one sweep over all rows. Returns the largest change of an impulse, N s or N m s of
  // motors, by which the sweeps end.
  double Sweep(LooseRocks* loose_rocks);
  // Returns what the row's left side lacks to its target.
  double Residual(const Row& row) const;
  // Sets the row's impulse and lets the change act on rover and rock.
  void Apply(double impulse, Row& row);
  // Gives the row the impulse that satisfies it, within its bounds, with all other rows as they
  // are.
  void Relax(Row& row);
  // Relaxes a row whose impulse is at most `most_Ns` in either direction.
  void RelaxWithin(double most_Ns, Row& row);
  void RelaxFriction(ContactRows& rows);
  void StartDriven(ContactRows& rows);
  void RelaxDrivenFriction(const Eigen::Vector2d& lack_m_s, ContactRows& rows);
  // Sets the friction rows by the slip of the present motion; v_m_s: the contact's velocity over
  // the soil.
  void FollowSlip(const Eigen::Vector2d& v_m_s, ContactRows& rows) const;
  double RimSpeed(const ContactRows& rows, const DofVector& velocity) const;
  // Returns the velocity of the rover's point at the contact, along and across, m/s.
  static Eigen::Vector2d ContactVelocity(const ContactRows& rows, const DofVector& velocity);
  static std::array<double, 2> RightSide(const ContactRows& rows, const FrictionBlock& block,
                                         const Eigen::Vector2d& lack_m_s);

  const ContactLaws laws_;
  const double stall_torque_Nm_;
  const std::int64_t iterations_;
  const double wheel_radius_m_;
  const double mean_load_N_;

  SlipSinkage sinkage_;
  messages::PerWheel<double> slip_{};  // of the last step, on soil
  double step_s_;
  std::array<double, kStops> stop_angle_rad_{};
  DofVector velocity_ = DofVector::Zero();
  double largest_change_Ns_ = 0.0;        // of the impulse of a contact, in the present sweep
  DofVector before_ = DofVector::Zero();  // at the beginning of the step
  Row differential_;
  std::array<Row, kStops> stops_;
  messages::PerWheel<Row> motors_;
  messages::PerWheel<bool> touches_{};  // wheels that have a contact in this step
  std::vector<ContactRows> contacts_;   // capacity; the first contact_count_ are in use
  std::size_t contact_count_ = 0;
};

}  // namespace rockyard::rover
