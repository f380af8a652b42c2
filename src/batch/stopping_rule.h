// When a campaign has run enough trials of a cell.
#pragma once

#include <cstdint>

namespace rockyard::batch {

// Who gets the blocks of a round.
enum class Allocation {
  kUniform,   // every cell that has not ended gets one
  kAdaptive,  // the half of them (rounded up) with the widest intervals; at a tie the first
};

// A cell ends at the first block end where the interval of its declared success has at most this
// half-width. Simulator faults enter no rate. That the number of trials depends on what they say is
// allowed for in the interval (statistics::IntervalMethod::kStopped).
struct StoppingRule {
  double half_width = 0.02;
  std::int64_t max_trials = 10000;  // of a cell
  std::int64_t block = 25;          // trials between two decisions
  double confidence = 0.95;
  Allocation allocation = Allocation::kUniform;
  std::int64_t budget = 0;  // of trials, all cells together; 0: none

  bool operator==(const StoppingRule&) const = default;
};

}  // namespace rockyard::batch
