// What a contact of the multibody resists with: spring, damper, friction, slip and motion
// resistance. The constraint solver takes the laws of every contact in every step. Records depend
// on every operation, also on the s that FrictionBlock keeps from its last call.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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

  // Gets ready for calls with this softness, so that the next one need not divide.
  void Expect(double softness) {
    const double shift = slides_ ? std::max(shift_, softness) : softness;
    if (shift != shift_) Shift(shift);
  }

  // Returns the p of (A + s I) p = b, where s = softness (c) if then |p| <= most, and else s > c is
  // such that |p| = most. It finds s by Newton's method on the length
  // of p (More and Sorensen 1983 sec. 3), which approaches s from below without overshoot, and
  // starts from the s of the last call: one or two iterations within the sweeps of one step.
  std::array<double, 2> Solve(const std::array<double, 2>& b, double softness, double most) {
    if (most <= 0.0) return {0.0, 0.0};
    Expect(softness);
    const std::array<double, 2> p = SolveShifted(b);
    // Within the bound at s = c the contact holds.
    slides_ = shift_ != softness || p[0] * p[0] + p[1] * p[1] > most * most;
    return slides_ ? Slide(b, softness, most) : p;
  }

  double a0() const { return a0_; }
  double a1() const { return a1_; }
  double a01() const { return a01_; }

 private:
  void Shift(double shift) {
    shift_ = shift;
    const double a0 = a0_ + shift;
    const double a1 = a1_ + shift;
    const double inverse = 1.0 / (a0 * a1 - a01_ * a01_);
    i0_ = inverse * a1;
    i1_ = inverse * a0;
    i01_ = -inverse * a01_;
  }
  std::array<double, 2> Slide(const std::array<double, 2>& b, double softness, double most);
  std::array<double, 2> SolveShifted(const std::array<double, 2>& b) const {
    return {i0_ * b[0] + i01_ * b[1], i01_ * b[0] + i1_ * b[1]};
  }

  double a0_ = 1.0;
  double a1_ = 1.0;
  double a01_ = 0.0;
  bool slides_ = false;  // on the bound in the last call
  double shift_ = 0.0;   // s
  // (A + s I)^-1.
  double i0_ = 1.0;
  double i1_ = 1.0;
  double i01_ = 0.0;
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
  double per_traction_per_Ns = 0.0;  // 1 / (T_max h); 0 for soil without strength
  double per_shear_ratio = 0.0;
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
};

// What slip does within one step: the friction impulse p answers to the slip velocity at one moment
// of the step,
//   theta v_1 + (1 - theta) v_0 = -c p,
// with v_0 and v_1 the slip velocities at the beginning and at the end of the step. Progress
// (quasi_static/progress.h) takes the same theta.
struct SlipStep {
  double softness_m_per_Ns = 0.0;  // c
  double theta = 1.0;
  double per_theta = 1.0;  // 1 / theta
};

// i / tau over the slip i (Janosi and Hanamoto 1961): u / tau(u) by cubic interpolation of value
// and slope, within 1e-7, without the division of SlipPerShare (wheel_soil.h).
class RatioTable {
 public:
  RatioTable();

  // Returns i / tau at the slip i >= 0, for soil whose u at a slip of 1 is the shear ratio.
  double At(double slip, double shear_ratio, double per_shear_ratio) const {
    const double at = slip * shear_ratio * kPerWidth;
    if (!(at < kIntervals)) return Beyond(slip, shear_ratio);
    const auto index = static_cast<std::size_t>(at);
    const double s = at - static_cast<double>(index);
    const double r = 1.0 - s;
    const Node& a = nodes_[index];
    const Node& b = nodes_[index + 1];
    const double rise = b.value - a.value;
    return per_shear_ratio *
           (a.value + s * (rise + r * (r * (a.rise - rise) - s * (b.rise - rise))));
  }

 private:
  static constexpr int kIntervals = 256;
  static constexpr double kPerWidth = 16.0;
  struct Node {
    double value;
    double rise;  // slope times the width of an interval
  };
  static double Beyond(double slip, double shear_ratio);

  std::array<Node, kIntervals + 1> nodes_{};
};

// Finds the law of a contact from the rover's parameters and the soil.
class ContactLaws {
 public:
  ContactLaws(const RoverParams& params, const terrain::SoilParams& soil);

  // Returns the law of a contact whose impulses are those of a step of step_s; dug_slip: the slip
  // that a wheel has dug in for (SlipSinkage).
  ContactLaw Of(const Part& part, const Contact& contact, double step_s,
                double dug_slip = 0.0) const;

  // Returns what the slip of a wheel on soil does in one step of the length that `law` is for.
  // `theta` is what the last call for
  // the same step returned, 1 at the first call.
  //
  // Traction answers to slip the faster the slower the rim turns: its time constant is
  //   T = m |omega r| (i / tau) / T_max
  // for the mass m that the wheel carries, 16 ms at 15 cm/s on landscaping sand and next to nothing
  // for a wheel that has just begun to turn. theta = (z + 3) / (z + 6), z = h / T, makes what
  // remains of a disturbance after one step the Pade approximant (6 - 2 z) / (6 + 4 z + z^2) of
  // e^-z: of third order, and without ringing however short T is. With theta = 1 (backward Euler) a
  // rover that stops every 6.5 cm would lose a third of a millimetre more each time at 60 Hz.
  SlipStep StepOfSlip(const ContactLaw& law, const SlipChange& change, double theta) const {
    const double rest = 1.0 - theta;
    const double rim_m_s = theta * change.to.rim_m_s + rest * change.from.rim_m_s;
    // A wheel that stands does not creep, and soil without strength has no traction to build up.
    if (rim_m_s == 0.0 || law.per_traction_per_Ns == 0.0) return {};
    const double along_m_s = theta * change.to.v_m_s.x() + rest * change.from.v_m_s.x();
    const double across_m_s = theta * change.to.v_m_s.y() + rest * change.from.v_m_s.y();
    const double v_m_s = std::sqrt(along_m_s * along_m_s + across_m_s * across_m_s);
    // Slip speed v = |omega r| i is to come with the friction tau T_max (Janosi and Hanamoto 1961):
    //   c = v / (tau T_max h) = |omega r| (i / tau) / (T_max h).
    // c at the slip of the last sweep settles after a few sweeps, as i and tau grow together. c at
    // the traction of the last sweep would make wheels that share a slip take turns in pulling.
    const double slip = std::min(v_m_s / rim_m_s, 1.0);
    const double softness = rim_m_s * ratios_.At(slip, law.soil.shear_ratio, law.per_shear_ratio) *
                            law.per_traction_per_Ns;
    // z = h / T = 1 / (c m); soil without shear deformation answers at once.
    const double softness_times_mass = softness * law.load_N * per_gravity_s2_m_;
    const double above = 1.0 + 3.0 * softness_times_mass;
    const double below = 1.0 + 6.0 * softness_times_mass;
    const double inverse = 1.0 / (above * below);
    return {softness, above * above * inverse, below * below * inverse};
  }

  const WheelOnSoil& soil() const { return soil_; }
  // Returns the damping of every contact.
  double damping_Ns_m() const { return params_.damping_Ns_m; }

 private:
  ContactLaw OnSoil(double load_N, double dug_slip, double step_s) const;

  const RoverContactParams params_;
  const WheelOnSoil soil_;
  const RatioTable ratios_;
  const double per_gravity_s2_m_;
};

}  // namespace rockyard::rover
