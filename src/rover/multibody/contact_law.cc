#include "rover/multibody/contact_law.h"

#include <algorithm>
#include <cmath>

namespace rockyard::rover {
namespace {

// Error of |p| that ends the iteration, relative to the bound.
constexpr double kTolerance = 1e-9;
// Never reached: Newton doubles the digits in each iteration.
constexpr int kMaxIterations = 30;

// Returns the length of p, without the care for overflow that std::hypot pays for.
double Length(const std::array<double, 2>& p) { return std::sqrt(p[0] * p[0] + p[1] * p[1]); }

// Least load at which the soil's answer is looked up, N: a wheel that has just touched has no load
// yet. All forces are ratios to the load, so that they vanish with it.
constexpr double kMinLoad_N = 0.1;

}  // namespace

void FrictionBlock::Set(double a0, double a1, double a01) {
  a0_ = a0;
  a1_ = a1;
  a01_ = a01;
  shift_ = 0.0;
}

std::array<double, 2> FrictionBlock::SolveShifted(const std::array<double, 2>& b) const {
  // p = (A + s I)^-1 b, by Cramer's rule.
  const double a0 = a0_ + shift_;
  const double a1 = a1_ + shift_;
  const double inverse = 1.0 / (a0 * a1 - a01_ * a01_);
  return {inverse * (a1 * b[0] - a01_ * b[1]), inverse * (a0 * b[1] - a01_ * b[0])};
}

std::array<double, 2> FrictionBlock::Solve(const std::array<double, 2>& b, double softness,
                                           double most) {
  if (most <= 0.0) return {0.0, 0.0};
  shift_ = std::max(shift_, softness);
  std::array<double, 2> p = SolveShifted(b);
  for (int i = 0; i < kMaxIterations; ++i) {
    // |p| falls as s grows. Within the bound at s = c the contact holds; otherwise s is the root of
    // |p(s)| = most, where A p - b = -s p: what slides on is opposite to the friction.
    const double size = Length(p);
    const bool holds = shift_ == softness && size <= most;
    if (holds || std::abs(size - most) <= kTolerance * most) return p;
    // dp/ds = -(A + s I)^-1 p = -q, so d|p|/ds = -p . q / |p|. Newton's method on 1/|p| = 1/most,
    // nearly linear in s: ds = (|p| / most - 1) |p| / slope.
    const std::array<double, 2> q = SolveShifted(p);
    const double slope = (p[0] * q[0] + p[1] * q[1]) / size;  // -d|p| / ds
    shift_ = std::max(softness, shift_ + (size / most - 1.0) * size / slope);
    p = SolveShifted(b);
  }
  return p;
}

ContactLaws::ContactLaws(const RoverParams& params, const terrain::SoilParams& soil)
    : params_(params.contact),
      soil_(MakeWheelOnSoil(params, soil)),
      gravity_m_s2_(params.physics.gravity_m_s2) {}

ContactLaw ContactLaws::Of(const Part& part, const Contact& contact, double step_s,
                           double dug_slip) const {
  const bool wheel = part.kind == truth::BodyPart::kWheel;
  if (wheel && contact.IsSoil()) {
    return OnSoil(std::max(contact.impulse_Ns[0] / step_s, kMinLoad_N), dug_slip);
  }
  // Rocks and walls, and the body on anything: a spring with Coulomb friction.
  ContactLaw law;
  law.stiffness_N_m = params_.stiffness_N_m;
  law.friction =
      wheel && contact.other >= 0 ? params_.wheel_rock_friction : params_.body_rock_friction;
  return law;
}

ContactLaw ContactLaws::OnSoil(double load_N, double dug_slip) const {
  ContactLaw law;
  law.slips = true;
  law.load_N = load_N;
  law.soil = soil_.Under(load_N, dug_slip);
  // The soil's sinkage z(N) in series with the contact's own spring k_c, along the tangent at this
  // load:
  //   1/k = 1 / (dN/dz) + 1 / k_c,   d_0 = z + N / k_c - N / k (there the tangent has no force).
  law.stiffness_N_m = 1.0 / (1.0 / law.soil.stiffness_N_m + 1.0 / params_.stiffness_N_m);
  law.rest_depth_m =
      law.soil.sinkage_m + load_N / params_.stiffness_N_m - load_N / law.stiffness_N_m;
  // Mohr and Coulomb's T_max and Bekker's R as ratios to the load, which the solver multiplies by
  // the normal impulse of the moment.
  law.friction = law.soil.traction_N / load_N;
  law.drag_ratio = law.soil.resistance_N / load_N;
  law.side_ratio = law.soil.side_N / load_N;
  return law;
}

SlipStep ContactLaws::StepOfSlip(const ContactLaw& law, const SlipChange& change,
                                 double theta) const {
  const WheelSlip& from = change.from;
  const WheelSlip& to = change.to;
  const double rim_m_s = theta * to.rim_m_s + (1.0 - theta) * from.rim_m_s;
  // A wheel that stands does not creep.
  if (rim_m_s == 0.0) return {};
  // Soil without strength has no traction to build up.
  if (law.soil.traction_N <= 0.0) return {};
  const double v_m_s = (theta * to.v_m_s + (1.0 - theta) * from.v_m_s).norm();
  // Slip speed v = |omega r| i is to come with the friction tau T_max (Janosi and Hanamoto 1961):
  //   c = v / (tau T_max h) = |omega r| (i / tau) / (T_max h).
  // c at the slip of the last sweep settles after a few sweeps, as i and tau grow together. c at
  // the traction of the last sweep would make wheels that share a slip take turns in pulling.
  const double slip = std::min(v_m_s / rim_m_s, 1.0);
  const double softness = rim_m_s * SlipPerShare(slip, law.soil.shear_ratio, shares_) /
                          (law.soil.traction_N * change.duration_s);
  // z = h / T = 1 / (c m); soil without shear deformation answers at once.
  const double softness_times_mass = softness * law.load_N / gravity_m_s2_;
  return {softness, (1.0 + 3.0 * softness_times_mass) / (1.0 + 6.0 * softness_times_mass)};
}

}  // namespace rockyard::rover
