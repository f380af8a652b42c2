#include "rover/multibody/contact_law.h"

#include <algorithm>
#include <cmath>

namespace rockyard::rover {
namespace {

// Error of |p| that ends the iteration, relative to the bound.
constexpr double kTolerance = 1e-9;
// Never reached: Newton doubles the digits in each iteration.
constexpr int kMaxIterations = 30;

// Least load at which the soil's answer is looked up, N: a wheel that has just touched has no load
// yet. All forces are ratios to the load, so that they vanish with it.
constexpr double kMinLoad_N = 0.1;

}  // namespace

void FrictionBlock::Set(double a0, double a1, double a01) {
  a0_ = a0;
  a1_ = a1;
  a01_ = a01;
  slides_ = false;
  Shift(0.0);
}

// s is the root of |p(s)| = most, where A p - b = -s p: what slides on is opposite to the friction.
std::array<double, 2> FrictionBlock::Slide(const std::array<double, 2>& b, double softness,
                                           double most) {
  std::array<double, 2> p = SolveShifted(b);
  for (int i = 0; i < kMaxIterations; ++i) {
    const double size2 = p[0] * p[0] + p[1] * p[1];
    const double size = std::sqrt(size2);
    slides_ = shift_ != softness || size > most;
    if (!slides_ || std::abs(size - most) <= kTolerance * most) return p;
    // dp/ds = -(A + s I)^-1 p = -q, so d|p|/ds = -p . q / |p|. Newton's method on 1/|p| = 1/most,
    // nearly linear in s: ds = (|p| - most) |p|^2 / (most p . q).
    const std::array<double, 2> q = SolveShifted(p);
    const double slope = most * (p[0] * q[0] + p[1] * q[1]);
    Shift(std::max(softness, shift_ + (size - most) * size2 / slope));
    p = SolveShifted(b);
  }
  return p;
}

RatioTable::RatioTable() {
  // u / tau = 2 + 2 u / 3 + ... at 0.
  nodes_[0] = {2.0, 2.0 / 3.0 / kPerWidth};
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    const double u = static_cast<double>(i) / kPerWidth;
    const ShearShare tau = ShareOfRatio(u);
    nodes_[i] = {u / tau.value, (tau.value - u * tau.slope) / (tau.value * tau.value) / kPerWidth};
  }
}

double RatioTable::Beyond(double slip, double shear_ratio) {
  // Soil that shears without deformation mobilizes all of its strength at any slip.
  if (std::isinf(shear_ratio)) return 0.0;
  // tau = 1 - 1 / u, as e^-u is nothing.
  const double u = slip * shear_ratio;
  return slip * u / (u - 1.0);
}

ContactLaws::ContactLaws(const RoverParams& params, const terrain::SoilParams& soil)
    : params_(params.contact),
      soil_(MakeWheelOnSoil(params, soil)),
      per_gravity_s2_m_(1.0 / params.physics.gravity_m_s2) {}

ContactLaw ContactLaws::Of(const Part& part, const Contact& contact, double step_s,
                           double dug_slip) const {
  const bool wheel = part.kind == truth::BodyPart::kWheel;
  if (wheel && contact.IsSoil()) {
    return OnSoil(std::max(contact.impulse_Ns[0] / step_s, kMinLoad_N), dug_slip, step_s);
  }
  // Rocks and walls, and the body on anything: a spring with Coulomb friction.
  ContactLaw law;
  law.stiffness_N_m = params_.stiffness_N_m;
  law.friction =
      wheel && contact.other >= 0 ? params_.wheel_rock_friction : params_.body_rock_friction;
  return law;
}

ContactLaw ContactLaws::OnSoil(double load_N, double dug_slip, double step_s) const {
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
  if (law.soil.traction_N > 0.0) law.per_traction_per_Ns = 1.0 / (law.soil.traction_N * step_s);
  law.per_shear_ratio = 1.0 / law.soil.shear_ratio;
  return law;
}

}  // namespace rockyard::rover
