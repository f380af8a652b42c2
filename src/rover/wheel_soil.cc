#include "rover/wheel_soil.h"

#include <algorithm>
#include <cmath>

namespace rockyard::rover {
namespace {

// Below this u the closed form loses digits to cancellation; the series u/2 - u^2/6 has an error of
// u^3 / 24.
constexpr double kSeries = 1e-4;

}  // namespace

ShearShare ShareOfRatio(double u) {
  if (u < kSeries) return {u * (0.5 - u / 6.0), 0.5 - u / 3.0};
  // tau = 1 - (1 - e^-u) / u and, by the quotient rule, tau' = ((1 - e^-u) / u - e^-u) / u.
  const double loss = std::expm1(-u);  // e^-u - 1
  const double rest = -loss / u;
  return {1.0 - rest, (rest - loss - 1.0) / u};
}

double ShearRatio(double tau) {
  if (tau <= 0.0) return 0.0;
  // tau(u) is concave and increasing, so Newton from the left of the root stays there and converges
  // monotonically. Both starts are left of it: tau <= u / 2, and tau <= 1 - e^-u gives u = (1 -
  // e^-u) / (1 - tau) >= tau / (1 - tau).
  double u = std::max(2.0 * tau, tau / (1.0 - tau));
  for (int i = 0; i < 30; ++i) {
    const ShearShare share = ShareOfRatio(u);
    const double step = (tau - share.value) / share.slope;
    u += step;
    if (std::abs(step) <= 1e-12 * u) break;
  }
  return u;
}

WheelSoil::WheelSoil(const terrain::SoilParams& soil, double wheel_radius_m, double wheel_width_m)
    : WheelRut(soil, wheel_radius_m, wheel_width_m), shear_modulus_m_(soil.shear_modulus_m) {}

double WheelSoil::ShearRatioOfFullSlip(double load_N) const {
  return ContactLength_m(load_N) / shear_modulus_m_;
}

double WheelSoil::TractionShare(double slip, double load_N) const {
  if (slip <= 0.0) return 0.0;
  // K = 0: the soil shears without deformation, so any slip mobilizes all of its strength.
  if (shear_modulus_m_ == 0.0) return 1.0;
  return ShareOfRatio(slip * ShearRatioOfFullSlip(load_N)).value;
}

double WheelSoil::Slip(double tau, double load_N) const {
  if (tau <= 0.0 || load_N <= 0.0) return 0.0;
  // More than full slip mobilizes: the wheel spins on the spot.
  if (tau >= TractionShare(1.0, load_N)) return 1.0;
  // i = u K / l.
  return std::min(1.0, shear_modulus_m_ / ContactLength_m(load_N) * ShearRatio(tau));
}

double WheelSoil::SlipPerShare(double slip, const Rut& rut) const {
  if (shear_modulus_m_ == 0.0) return 0.0;
  const double ratio = shear_modulus_m_ / rut.contact_length_m;
  // u = i l / K; tau tends to u / 2, so i / tau to 2 K / l.
  const double u = slip / ratio;
  return u == 0.0 ? 2.0 * ratio : slip / ShareOfRatio(u).value;
}

}  // namespace rockyard::rover
