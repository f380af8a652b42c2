// Velocity constraints of one step of RockerBogie: differential, joint stops, motors, contacts with
// friction, slip and motion resistance. They are solved by projected Gauss-Seidel, started from the
// impulses of the last step. Records depend on the order of the rows in a sweep (differential,
// stops, motors of wheels without a contact, contact by contact) and on the impulses that it starts
// from, as the number of sweeps is bounded.
#pragma once

#include <array>
#include <vector>

#include "messages/wheels.h"
#include "rover/motor_ramp.h"
#include "rover/multibody/contact_block.h"
#include "rover/multibody/contact_finder.h"
#include "rover/multibody/contact_law.h"
#include "rover/multibody/joint_space_inertia.h"
#include "rover/multibody/loose_rocks.h"
#include "rover/multibody/multibody.h"
#include "rover/rover_params.h"
#include "rover/wheel_soil.h"
#include "terrain/soil_params.h"

namespace rockyard::rover {

// Solves all constraints of one step together, after gravity and motion have accelerated the free
// rover. The table in src/rover/README.md lists the rows.
class ConstraintSolver {
 public:
  ConstraintSolver(const RoverParams& params, const terrain::SoilParams& soil);

  // Forgets the impulses of the last step, and how far wheels have dug in.
  void Clear();

  // What a step begins with.
  struct Step {
    const JointSpaceInertia& inertia;
    const DofVector& before;  // velocities before gravity accelerated the body
    const MotorRates& rates;  // told to the wheels' motors
    double duration_s = 0.0;
    int patience = 1;  // how many times as many sweeps as usual it may take
  };

  // Changes the velocities of `body`, already accelerated by gravity, so that they keep all
  // constraints. Leaves the impulses in the contacts. Rocks are fixed where loose_rocks is null.
  void Solve(const Step& step, LooseRocks* loose_rocks, ContactFinder& finder, Multibody& body);

  // Returns the length of the last step.
  double step_s() const { return step_s_; }
  // Returns the mean torque of a wheel's motor over the last step.
  double MotorTorque_Nm(std::size_t wheel) const { return motors_[wheel].impulse / step_s_; }

 private:
  static constexpr std::size_t kStops = 4;  // rockers and bogies

  // Scales the impulses of a step of another length, from which this step starts.
  void SetStep(double step_s, LooseRocks* loose_rocks, ContactFinder& finder);
  void StartDifferential(const JointSpaceInertia& inertia, const Multibody& body);
  void StartStops(const JointSpaceInertia& inertia, const Multibody& body);
  void StartMotors(const JointSpaceInertia& inertia, const messages::PerWheel<double>& rate_rad_s);
  void MarkActive(const Multibody& body, ContactFinder& finder) const;
  void StartContact(const JointSpaceInertia& inertia, const Part& part, const Multibody& body,
                    LooseRock* rock, Contact& contact);
  double DugSlip(std::size_t wheel) const;
  void Dig(const DofVector& before, const DofVector& after, const JointSpaceInertia& inertia);

  // Makes one sweep over all rows. Returns the largest change of an impulse, N s or N m s of
  // motors, by which the sweeps end.
  double Sweep(LooseRocks* loose_rocks);
  // Gives a row the impulse that satisfies it; returns the change.
  double RelaxDifferential();
  double Relax(double sign, const UnitRow& row, Bounds& bounds);

  const ContactLaws laws_;
  const double stall_torque_Nm_;
  const std::int64_t iterations_;
  const double wheel_radius_m_;
  const double mean_load_N_;

  SlipSinkage sinkage_;
  messages::PerWheel<double> slip_{};  // of the last step, on soil
  double step_s_;
  std::array<double, kStops> stop_angle_rad_{};
  UnitVelocity velocity_;
  UnitVelocity unit_before_;                     // at the beginning of the step
  messages::PerWheel<double> rim_before_m_s_{};  // likewise
  std::array<UnitRow, 2> rockers_;               // whose sum the differential sees
  Bounds differential_;
  std::array<UnitRow, kStops> stop_rows_;
  std::array<double, kStops> stop_sign_{};
  std::array<Bounds, kStops> stops_;
  messages::PerWheel<UnitRow> motor_rows_;
  messages::PerWheel<Bounds> motors_;
  messages::PerWheel<bool> touches_{};  // wheels that have a contact in this step
  std::vector<ContactBlock> contacts_;  // capacity; the first contact_count_ are in use
  std::size_t contact_count_ = 0;
};

}  // namespace rockyard::rover
