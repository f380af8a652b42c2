// The chi-squared distribution: squared errors in units of their own covariance.
#pragma once

namespace rockyard::core {

// Value below which a chi-squared number of `degrees` >= 1 degrees of freedom lies with probability
// p, 0 <= p < 1 (Boost.Math).
double ChiSquaredQuantile(double p, int degrees);

}  // namespace rockyard::core
