#include "rover/multibody/contact_law.h"

#include <algorithm>
#include <cmath>

namespace rockyard::rover {
namespace {

// Loads below this are taken as this where the soil's answer is looked up, N: a wheel that has just
// touched has none, and all of it vanishes with the load.
constexpr double kMinLoad_N = 0.1;

}  // namespace

ContactLaws::ContactLaws(const RoverParams& params, const terrain::SoilParams& soil)
    : params_(params.contact),
      soil_(soil, params.geometry.wheel_radius_m, params.geometry.wheel_width_m),
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
  law.rut = soil_.RutUnder(load_N, dug_slip);
  // The soil's sinkage z(N) in series with the contact's own spring k_c, along the tangent at this
  // load:
  //   1/k = 1 / (dN/dz) + 1 / k_c,   d_0 = z + N / k_c - N / k (there the tangent has no force).
  law.stiffness_N_m = 1.0 / (1.0 / law.rut.stiffness_N_m + 1.0 / params_.stiffness_N_m);
  law.rest_depth_m =
      law.rut.sinkage_m + load_N / params_.stiffness_N_m - load_N / law.stiffness_N_m;
  // Mohr and Coulomb's T_max and Bekker's R as ratios to the load, which the solver multiplies by
  // the normal impulse of the moment.
  law.friction = law.rut.largest_traction_N / load_N;
  law.drag_ratio = law.rut.resistance_N / load_N;
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
  if (law.rut.largest_traction_N <= 0.0) return {};
  const double v_m_s = (theta * to.v_m_s + (1.0 - theta) * from.v_m_s).norm();
  // Slip speed v = |omega r| i is to come with the friction tau T_max (Janosi and Hanamoto 1961):
  //   c = v / (tau T_max h) = |omega r| (i / tau) / (T_max h).
  // Both grow together, so c at the slip of the last sweep is found again after a few; the same
  // ratio at the traction of the last sweep would make wheels that share a slip take turns in
  // pulling.
  const double slip = std::min(v_m_s / rim_m_s, 1.0);
  const double softness = rim_m_s * soil_.SlipPerShare(slip, law.rut, shares_) /
                          (law.rut.largest_traction_N * change.duration_s);
  // z = h / T = 1 / (c m); soil without shear deformation answers at once.
  const double softness_times_mass = softness * law.rut.load_N / gravity_m_s2_;
  return {softness, (1.0 + 3.0 * softness_times_mass) / (1.0 + 6.0 * softness_times_mass)};
}

}  // namespace rockyard::rover
