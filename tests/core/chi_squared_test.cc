#include "core/chi_squared.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rockyard::core {
namespace {

TEST(ChiSquaredQuantile, IsThatOfTheTables) {
  EXPECT_NEAR(ChiSquaredQuantile(0.95, 1), 3.8415, 1e-4);
  EXPECT_NEAR(ChiSquaredQuantile(0.95, 3), 7.8147, 1e-4);
  EXPECT_NEAR(ChiSquaredQuantile(0.05, 3), 0.3518, 1e-4);
}

// Two degrees of freedom are an exponential distribution of mean 2.
TEST(ChiSquaredQuantile, HasAClosedFormForTwo) {
  for (const double p : {0.0, 0.1, 0.5, 0.999}) {
    EXPECT_NEAR(ChiSquaredQuantile(p, 2), -2.0 * std::log1p(-p), 1e-10);
  }
}

}  // namespace
}  // namespace rockyard::core
