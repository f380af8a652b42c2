// What may be shown of an unfinished run.
#pragma once

#include <cstdint>
#include <vector>

#include "truth/record.h"

namespace rockyard::batch {

// Counts over trials 0 .. trials-1, all of which are finished.
struct PrefixCounts {
  std::int64_t trials = 0;
  std::int64_t faults = 0;
  std::int64_t measured = 0;  // no drives: neither success nor failure
  std::int64_t declared_successes = 0;
};

// Finished trials arrive in any order; rates use only the contiguous prefix of their indices.
// Trials that fail run longer, so that over completion order successes would be counted too often;
// the prefix waits for every trial before it.
class PrefixCounter {
 public:
  // Each trial at most once; 0 <= trial.
  void Add(std::int64_t trial, truth::TrialOutcome outcome);

  std::int64_t finished() const { return finished_; }
  std::int64_t faults() const { return faults_; }
  const PrefixCounts& prefix() const { return prefix_; }

 private:
  static constexpr std::int8_t kPending = -1;

  std::vector<std::int8_t> outcomes_;  // by trial
  std::int64_t finished_ = 0;
  std::int64_t faults_ = 0;
  PrefixCounts prefix_;
};

}  // namespace rockyard::batch
