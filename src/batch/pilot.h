// What a trial costs, from a few of them.
#pragma once

#include <cstdint>
#include <string>

#include "experiments/experiment.h"

namespace rockyard::batch {

// Zero trials: there were none.
struct PilotCost {
  std::int64_t trials = 0;
  double mean_s = 0.0;       // CPU time of a trial
  double variance_s2 = 0.0;  // unbiased; 0 below two trials
  double slowest_s = 0.0;
  std::string hash;  // of the records
};

// Runs trials 0 .. trials-1 on this thread and keeps nothing of them but their cost and their hash.
// The times are measured: they differ from run to run. An exception of a trial counts as its end.
PilotCost RunPilots(const experiments::Experiment& experiment, std::uint64_t seed, int trials);

}  // namespace rockyard::batch
