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
      wheel_radius_m_(params.geometry.wheel_radius_m),
      step_s_(params.physics.step_s) {}

ContactLaw ContactLaws::Of(const Part& part, const Contact& contact, double spin_rad_s) const {
  const bool wheel = part.kind == truth::BodyPart::kWheel;
  if (wheel && contact.IsSoil()) return OnSoil(contact, spin_rad_s);
  // Rocks and walls, and the body on anything: a spring with Coulomb friction.
  return {.stiffness_N_m = params_.stiffness_N_m,
          .friction = wheel && contact.other >= 0 ? params_.wheel_rock_friction
                                                  : params_.body_rock_friction};
}

ContactLaw ContactLaws::OnSoil(const Contact& contact, double spin_rad_s) const {
  const double load_N = std::max(contact.impulse_Ns[0] / step_s_, kMinLoad_N);
  const Rut rut = soil_.RutUnder(load_N);
  ContactLaw law;
  // The soil's sinkage z(N) in series with the contact's own spring k_c, along the tangent at this
  // load:
  //   1/k = 1 / (dN/dz) + 1 / k_c,   d_0 = z + N / k_c - N / k (there the tangent has no force).
  law.stiffness_N_m = 1.0 / (1.0 / rut.stiffness_N_m + 1.0 / params_.stiffness_N_m);
  law.rest_depth_m = rut.sinkage_m + load_N / params_.stiffness_N_m - load_N / law.stiffness_N_m;
  // Mohr and Coulomb's T_max and Bekker's R as ratios to the load, which the solver multiplies by
  // the normal impulse of the moment.
  law.friction = rut.largest_traction_N / load_N;
  law.drag_ratio = rut.resistance_N / load_N;
  // Slip speed v = |omega r| i is to come with the friction tau T_max (Janosi and Hanamoto 1961):
  // the row's softness is c = v / (tau T_max h) = |omega r| (i / tau) / (T_max h). Both grow
  // together, so c at the slip of the last step is found again after a few steps; the same ratio at
  // the traction of the last step would make wheels that share a slip take turns in pulling. A
  // wheel that stands does not creep.
  const double rim_m_s = std::abs(spin_rad_s) * wheel_radius_m_;
  if (rim_m_s == 0.0) return law;
  const double slip = std::min(contact.slip_m_s / rim_m_s, 1.0);
  law.slip_softness_m_per_Ns =
      rim_m_s * soil_.SlipPerShare(slip, rut) / (rut.largest_traction_N * step_s_);
  return law;
}

}  // namespace rockyard::rover
