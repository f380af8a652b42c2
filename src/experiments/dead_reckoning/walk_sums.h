// What one run of the experiment "dead_reckoning" adds up.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "core/check.h"

namespace rockyard::experiments {

// How a walk ended: what is believed less what is true.
struct WalkError {
  double along_m = 0.0;   // in the direction of the start
  double across_m = 0.0;  // to its left
  double heading_deg = 0.0;
  double distance_m = 0.0;  // of the odometer
};

// Sum, sum of squares and standard deviation of one error over the walks of a run.
struct ErrorSums {
  double sum = 0.0;
  double squares = 0.0;
  double deviation = 0.0;  // n times the sample's, so that runs add up to a mean per walk
};

// Needs two errors or more.
inline ErrorSums SumsOf(const std::vector<WalkError>& errors, double WalkError::*error) {
  EXPECT(errors.size() >= 2);
  const auto n = static_cast<double>(errors.size());
  ErrorSums sums;
  for (const WalkError& walk : errors) {
    sums.sum += walk.*error;
    sums.squares += walk.*error * (walk.*error);
  }
  const double mean = sums.sum / n;
  double about_mean = 0.0;
  for (const WalkError& walk : errors) about_mean += (walk.*error - mean) * (walk.*error - mean);
  sums.deviation = n * std::sqrt(about_mean / (n - 1.0));
  return sums;
}

struct WalkSums {
  double walks = 0.0;
  double way_m = 0.0;         // of all walks together
  double within_reach = 0.0;  // walks that end near enough to where they should
  ErrorSums along_m;
  ErrorSums across_m;
  ErrorSums heading_deg;
  ErrorSums distance_m;
};

// Calls f(name, value) for every column, in the order of the records.
template <typename F>
void ForEachSum(const WalkSums& s, F&& f) {
  const auto error = [&](const std::string& name, const std::string& unit, const ErrorSums& sums) {
    f(name + "_bias_" + unit, sums.sum);
    f(name + "_error_" + unit, sums.squares);
    f(name + "_deviation_" + unit, sums.deviation);
  };
  f("walks", s.walks);
  f("way_m", s.way_m);
  f("within_reach", s.within_reach);
  error("along", "m", s.along_m);
  error("across", "m", s.across_m);
  error("heading", "deg", s.heading_deg);
  error("distance", "m", s.distance_m);
}

}  // namespace rockyard::experiments
