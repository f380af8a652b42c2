#include "core/chi_squared.h"

#include <boost/math/distributions/chi_squared.hpp>

#include "core/check.h"

namespace rockyard::core {

double ChiSquaredQuantile(double p, int degrees) {
  EXPECT(p >= 0.0 && p < 1.0 && degrees >= 1);
  return boost::math::quantile(boost::math::chi_squared(degrees), p);
}

}  // namespace rockyard::core
