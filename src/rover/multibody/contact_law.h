// What a contact of the multibody resists with: spring, damper, friction, slip and motion
// resistance. The constraint solver takes the laws of every contact in every step. Records depend
// on every operation, also on the s that FrictionBlock keeps from its last call.
#pragma once

#include <Eigen/Core>
#include <array>

#include "rover/multibody/contact_finder.h"
#include "rover/part_shapes.h"
#include "rover/rover_params.h"
#include "rover/wheel_soil.h"

namespace rockyard::rover {

// Finds impulses p = (p0, p1) with |p| <= most for which the velocity that remains at the contact,
// A p - b, is -c p or, where the bound holds p back, faster and still exactly opposite to p:
// Coulomb's law with the principle of largest dissipation. A, symmetric and positive definite, is
// the velocity that a unit impulse causes at the contact, and c >= 0 how it yields to impulses
// within the bound. Taking the rows one by one, or each with its own diagonal, would turn sliding
// friction away from the direction of sliding.
class FrictionBlock {
 public:
  // Sets A = [a0 a01; a01 a1] and forgets s.
  void Set(double a0, double a1, double a01);

  // Returns the p of (A + s I) p = b, where s = softness (c) if then |p| <= most, and else s > c is
  // such that |p| = most. It finds s by Newton's method on the length of p (More and Sorensen 1983
  // sec. 3), which approaches s from below without overshoot, and starts from the s of the last
  // call: one or two iterations within the sweeps of one step.
  std::array<double, 2> Solve(const std::array<double, 2>& b, double softness, double most);

  double a0() const { return a0_; }
  double a1() const { return a1_; }
  double a01() const { return a01_; }

 private:
  std::array<double, 2> SolveShifted(const std::array<double, 2>& b) const;

  double a0_ = 1.0;
  double a1_ = 1.0;
  double a01_ = 0.0;
  double shift_ = 0.0;  // s
};

// The law of one contact in one step. Its normal force is the stiffness times the penetration
// beyond rest_depth_m, less the damping.
struct ContactLaw {
  double stiffness_N_m = 0.0;
  double rest_depth_m = 0.0;
  double friction = 0.0;    // largest friction over load
  double drag_ratio = 0.0;  // motion resistance over load
  double side_ratio = 0.0;  // resistance of a wheel's side face over load
  bool slips = false;       // a wheel on soil: friction comes with slip
  // Where it slips: the load of the last step, and the answer of the soil to it.
  double load_N = 0.0;
  SoilAnswer soil{};
};

// Rim speed of a wheel, m/s, and the velocity of its contact over the soil, along and across, m/s.
struct WheelSlip {
  double rim_m_s = 0.0;
  Eigen::Vector2d v_m_s = Eigen::Vector2d::Zero();
};

// The slip of a wheel at the beginning and at the end of a step.
struct SlipChange {
  WheelSlip from;
  WheelSlip to;
  double duration_s = 0.0;
};

// What slip does within one step: the friction impulse p answers to the slip velocity at one moment
// of the step,
//   theta v_1 + (1 - theta) v_0 = -c p,
// with v_0 and v_1 the slip velocities at the beginning and at the end of the step. Progress
// (quasi_static/progress.h) takes the same theta.
struct SlipStep {
  double softness_m_per_Ns = 0.0;  // c
  double theta = 1.0;
};

// Finds the law of a contact from the rover's parameters and the soil.
class ContactLaws {
 public:
  ContactLaws(const RoverParams& params, const terrain::SoilParams& soil);

  // Returns the law of a contact whose impulses are those of a step of step_s; dug_slip: the slip
  // that a wheel has dug in for (SlipSinkage).
  ContactLaw Of(const Part& part, const Contact& contact, double step_s,
                double dug_slip = 0.0) const;

  // Returns what the slip of a wheel on soil does in one step. `theta` is what the last call for
  // the same step returned, 1 at the first call.
  //
  // Traction answers to slip the faster the slower the rim turns: its time constant is
  //   T = m |omega r| (i / tau) / T_max
  // for the mass m that the wheel carries, 16 ms at 15 cm/s on landscaping sand and next to nothing
  // for a wheel that has just begun to turn. theta = (z + 3) / (z + 6), z = h / T, makes what
  // remains of a disturbance after one step the Pade approximant (6 - 2 z) / (6 + 4 z + z^2) of
  // e^-z: of third order, and without ringing however short T is. With theta = 1 (backward Euler) a
  // rover that stops every 6.5 cm would lose a third of a millimetre more each time at 60 Hz.
  SlipStep StepOfSlip(const ContactLaw& law, const SlipChange& change, double theta) const;

  const WheelOnSoil& soil() const { return soil_; }
  // Returns the damping of every contact.
  double damping_Ns_m() const { return params_.damping_Ns_m; }

 private:
  ContactLaw OnSoil(double load_N, double dug_slip) const;

  const RoverContactParams params_;
  const WheelOnSoil soil_;
  const ShareTable shares_;
  const double gravity_m_s2_;
};

}  // namespace rockyard::rover
