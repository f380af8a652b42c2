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

  // Those that a success rate is about.
  std::int64_t drives() const { return trials - faults - measured; }
  PrefixCounts& operator+=(const PrefixCounts& other);
};

// Of any trials.
struct FinishedCounts {
  std::int64_t trials = 0;
  std::int64_t faults = 0;  // of these
};

// Finished trials arrive in any order; rates use only the contiguous prefix of their indices.
// Trials that fail run longer, so that over completion order successes would be counted too often;
// the prefix waits for every trial before it. Memory: one byte per trial.
class PrefixCounter {
 public:
  // 0 <= trial. False, and nothing changes, where the trial has been added before.
  bool Add(std::int64_t trial, truth::TrialOutcome outcome);

  bool Has(std::int64_t trial) const;
  // One more than the largest trial that was added.
  std::int64_t end() const { return static_cast<std::int64_t>(outcomes_.size()); }
  // Counts over from <= trial < to, all of which are finished.
  PrefixCounts Count(std::int64_t from, std::int64_t to) const;

  // Those below `to`. Cost: linear in `to` where there are others.
  FinishedCounts Finished(std::int64_t to) const;
  std::int64_t finished() const { return finished_.trials; }
  const PrefixCounts& prefix() const { return prefix_; }

 private:
  static constexpr std::int8_t kPending = -1;

  std::vector<std::int8_t> outcomes_;  // by trial
  FinishedCounts finished_;
  PrefixCounts prefix_;
};

}  // namespace rockyard::batch
