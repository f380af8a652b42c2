// How the traction of a wheel on soil builds up with its slip (Janosi and Hanamoto 1961, uniform
// pressure along the contact length l): T = tau T_max with
//   tau = 1 - (1 - e^-u) / u,   u = i l / K.
#pragma once

#include <array>
#include <cstddef>

namespace rockyard::rover {

// tau, the share of its largest traction that soil gives to a wheel that slips.
struct ShearShare {
  double value;
  double slope;  // by u
};
// Returns tau(u) = 1 - (1 - e^-u) / u and its derivative, for u >= 0. A call costs about 15 ns.
ShearShare ShareOfRatio(double u);

// ShareOfRatio by cubic interpolation of value and slope: within 1e-7 of tau, in a tenth of the
// time.
class ShareTable {
 public:
  ShareTable();

  // Returns tau(u) and its derivative, for u >= 0. The function stands in the header to be inlined:
  // balances ask for tau a million times in a trial.
  ShearShare At(double u) const;

 private:
  static constexpr int kIntervals = 256;
  static constexpr double kLast = 16.0;  // from here on e^-u is nothing
  std::array<ShearShare, kIntervals + 1> nodes_{};
};

inline ShearShare ShareTable::At(double u) const {
  // tau = 1 - (1 - e^-u) / u, without e^-u.
  if (u >= kLast) return {1.0 - 1.0 / u, 1.0 / (u * u)};
  constexpr double kWidth = kLast / kIntervals;
  const double at = u / kWidth;
  const auto index = static_cast<std::size_t>(at);
  const double s = at - static_cast<double>(index);
  const ShearShare& a = nodes_[index];
  const ShearShare& b = nodes_[index + 1];
  // Hermite's cubic through both values and slopes, and its derivative: with the rise d of the
  // chord and the differences p and q of the slopes from it,
  //   f = a + s (d + (1 - s) ((1 - s) p - s q)).
  const double d = b.value - a.value;
  const double p = kWidth * a.slope - d;
  const double q = kWidth * b.slope - d;
  const double r = 1.0 - s;
  const double value = a.value + s * (d + r * (r * p - s * q));
  const double slope = d + r * (r * p - s * q) + s * (-(r * p - s * q) - r * (p + q));
  return {value, slope / kWidth};
}

}  // namespace rockyard::rover
