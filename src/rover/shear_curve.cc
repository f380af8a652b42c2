#include "rover/shear_curve.h"

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

ShareTable::ShareTable() {
  for (int i = 0; i <= kIntervals; ++i) {
    nodes_[static_cast<std::size_t>(i)] = ShareOfRatio(kLast * i / kIntervals);
  }
}

}  // namespace rockyard::rover
