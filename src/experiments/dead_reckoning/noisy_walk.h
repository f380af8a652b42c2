// One walk along a straight line by dead reckoning whose measurements are noisy.
//
// Matthies 1995, section 5: x += dr cos(h), y += dr sin(h), h += dh, with dr = 6.7 cm and dh = 0,
// each corrupted in every step by independent normal noise. The rover truly drives along x; what
// it measures goes through the dead reckoning that flies, so that its end is the error.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/check.h"
#include "core/random.h"
#include "localization/dead_reckoning_params.h"
#include "messages/calibration.h"

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

// Of one step, all independent.
struct StepNoise {
  double distance_deviation_m = 0.0;
  double turn_deviation_rad = 0.0;       // in driving
  double rest_turn_deviation_rad = 0.0;  // while standing after it
};

// What all walks of a cell have in common.
struct WalkPlan {
  double step_m = 0.0;
  std::int64_t steps = 0;
  double step_s = 0.0;  // of driving
  double rest_s = 0.0;  // of standing after every step
  StepNoise noise;
  double scale_deviation = 0.0;  // of an error that a walk keeps
};

// The rover that walks: its wheels as they are, and what it believes of them.
struct WalkingRover {
  messages::DriveCalibration wheels;
  messages::DriveCalibration believed;
  localization::DeadReckoningParams dead_reckoning;
};

// Returns the error at the end. The noise comes from stream kExperiment of `key`. Cost: 0.15 us a
// step.
WalkError WalkStraight(const WalkingRover& rover, const WalkPlan& plan, core::TrialKey key);

}  // namespace rockyard::experiments
