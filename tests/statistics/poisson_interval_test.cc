#include "statistics/poisson_interval.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rockyard::statistics {
namespace {

// Garwood 1936, table 1, and the closed forms for none: no lower end, upper end -ln(tail).
TEST(PoissonIntervalTest, IsThePublishedTable) {
  EXPECT_EQ(PoissonInterval(0).low, 0.0);
  EXPECT_NEAR(PoissonInterval(0).high, -std::log(0.025), 1e-12);
  EXPECT_NEAR(PoissonInterval(1).low, -std::log(0.975), 1e-12);
  EXPECT_NEAR(PoissonInterval(10).low, 4.80, 0.005);
  EXPECT_NEAR(PoissonInterval(10).high, 18.39, 0.005);
  EXPECT_NEAR(PoissonInterval(10, 0.99).high, 21.40, 0.005);
}

// Its definition, by the sum of Poisson's probabilities.
TEST(PoissonIntervalTest, EndsLeaveTheTailsOnEitherSide) {
  for (const int count : {1, 3, 17}) {
    const Interval interval = PoissonInterval(count, 0.9);
    const auto at_most = [](int n, double mean) {
      double term = std::exp(-mean);
      double sum = term;
      for (int i = 1; i <= n; ++i) sum += term *= mean / i;
      return sum;
    };
    EXPECT_NEAR(1.0 - at_most(count - 1, interval.low), 0.05, 1e-10);
    EXPECT_NEAR(at_most(count, interval.high), 0.05, 1e-10);
  }
}

}  // namespace
}  // namespace rockyard::statistics
