#include "statistics/poisson_interval.h"

#include <boost/math/special_functions/gamma.hpp>

#include "core/check.h"

namespace rockyard::statistics {

Interval PoissonInterval(std::int64_t count, double confidence) {
  EXPECT(count >= 0 && confidence > 0.0 && confidence < 1.0);
  const double tail = 0.5 * (1.0 - confidence);
  const auto seen = static_cast<double>(count);
  // P(N >= n; mean) is the regularized lower incomplete gamma function P(n, mean), P(N <= n; mean)
  // the upper one Q(n + 1, mean).
  const double low = count == 0 ? 0.0 : boost::math::gamma_p_inv(seen, tail);
  return {low, boost::math::gamma_q_inv(seen + 1.0, tail)};
}

}  // namespace rockyard::statistics
