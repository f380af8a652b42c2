// Samplers built on RandomStream by inverse CDF: one uniform each (Poisson may take more), portable
// across standard libraries, unlike std::*_distribution.
#pragma once

#include <cstdint>

#include "core/random.h"

namespace rockyard::core {

// Value below which a chi-squared number of `degrees` >= 1 degrees of freedom lies with probability
// p, 0 <= p < 1 (Boost.Math).
double ChiSquaredQuantile(double p, int degrees);

// Uniform on (low, high).
double SampleUniform(RandomStream& stream, double low, double high);

// Value below which a standard normal number lies with probability p, 0 < p < 1.
double NormalQuantile(double p);

// Normal by inverse CDF (Boost.Math erf_inv in double precision), one uniform.
double SampleNormal(RandomStream& stream, double mean, double standard_deviation);

// Exponential with the given mean.
double SampleExponential(RandomStream& stream, double mean);

// True with the given probability.
bool SampleBernoulli(RandomStream& stream, double probability);

// Poisson count by sequential inversion; means over 200 are split into a sum of smaller ones.
std::int64_t SamplePoisson(RandomStream& stream, double mean);

}  // namespace rockyard::core
