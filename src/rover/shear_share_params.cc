#include "rover/shear_share_params.h"

#include "math/functions.h"

namespace rockyard::rover {
namespace {

// Below this u the closed form loses digits to cancellation; the series u/2 - u^2/6 has an error of
// u^3 / 24.
constexpr double kSeries = 1e-4;

}  // namespace

ShearShare ShareOfRatio(double u) {
  if (u < kSeries) return {u * (0.5 - u / 6.0), 0.5 - u / 3.0};
  // tau = 1 - (1 - e^-u) / u and, by the quotient rule, tau' = ((1 - e^-u) / u - e^-u) / u.
  const double loss = math::Expm1(-u);  // e^-u - 1
  const double rest = -loss / u;
  return {1.0 - rest, (rest - loss - 1.0) / u};
}

ShareTable::ShareTable() {
  for (int i = 0; i <= kIntervals; ++i) {
    nodes_[static_cast<std::size_t>(i)] = ShareOfRatio(kLast * i / kIntervals);
  }
}

}  // namespace rockyard::rover
