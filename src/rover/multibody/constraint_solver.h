// Velocity constraints of one step: differential, joint stops, motors, contacts with friction, slip
// and motion resistance. Projected Gauss-Seidel, started from the impulses of the last step.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "messages/wheels.h"
#include "rover/multibody/contact_finder.h"
#include "rover/multibody/contact_law.h"
#include "rover/multibody/friction_block.h"
#include "rover/multibody/loose_rocks.h"
#include "rover/multibody/multibody.h"
#include "rover/rover_params.h"
#include "terrain/soil_params.h"

namespace rockyard::rover {

// Solves all constraints of one step together, after Bullet has accelerated the free rover. The
// table in src/rover/README.md lists the rows.
class ConstraintSolver {
 public:
  ConstraintSolver(const RoverParams& params, const terrain::SoilParams& soil);

  // Forgets the impulses of the last step.
  void Clear();

  // Changes the velocities of `body`, already accelerated by gravity, so that they keep all
  // constraints; wheels are driven towards wheel_rate_rad_s. Leaves the impulses in the contacts.
  // Rocks yield where loose_rocks is given; null: they are fixed.
  void Solve(const DofMatrix& mass_inverse, const messages::PerWheel<double>& wheel_rate_rad_s,
             LooseRocks* loose_rocks, ContactFinder& finder, Multibody& body);

  // The mean torque of a wheel's motor over the last step.
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
    Row normal, along, across, drag;
    FrictionBlock friction;  // of along and across
  };
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  static constexpr std::size_t kStops = 4;  // rockers and bogies

  // Completes a row of given J, target, softness and impulse, and applies the impulse.
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
  void KeepForNextStep(const ContactRows& rows) const;

  void Sweep(LooseRocks* loose_rocks);
  // Returns what the row's left side lacks to its target.
  double Residual(const Row& row) const;
  // Sets the row's impulse and lets the change act on rover and rock.
  void Apply(double impulse, Row& row);
  // Gives the row the impulse that satisfies it, within its bounds, with all others as they are.
  void Relax(Row& row);
  void RelaxFriction(ContactRows& rows);

  const ContactLaws laws_;
  const double step_s_;
  const std::int64_t iterations_;

  std::array<double, kStops> stop_angle_rad_{};
  DofVector velocity_ = DofVector::Zero();
  messages::PerWheel<double> spin_rad_s_{};  // before the solution
  Row differential_;
  std::array<Row, kStops> stops_;
  messages::PerWheel<Row> motors_;
  std::vector<ContactRows> contacts_;  // capacity; the first contact_count_ are in use
  std::size_t contact_count_ = 0;
};

}  // namespace rockyard::rover
