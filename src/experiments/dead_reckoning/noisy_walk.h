// One walk along a straight line by dead reckoning whose measurements are noisy.
//
// Matthies 1995, section 5: x += dr cos(h), y += dr sin(h), h += dh, with dr = 6.7 cm and dh = 0,
// each corrupted in every step by independent normal noise. The rover truly drives along x; what
// it measures goes through the dead reckoning that flies, so that its end is the error.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "experiments/dead_reckoning/walk_sums.h"
#include "localization/dead_reckoning_params.h"
#include "messages/calibration.h"

namespace rockyard::experiments {

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
