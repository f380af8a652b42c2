#include "batch/prefix_counter.h"

#include "core/check.h"

namespace rockyard::batch {
namespace {

PrefixCounts CountOf(truth::TrialOutcome outcome) {
  PrefixCounts counts;
  counts.trials = 1;
  counts.faults = outcome == truth::TrialOutcome::kSimulatorFault ? 1 : 0;
  counts.measured = outcome == truth::TrialOutcome::kMeasured ? 1 : 0;
  counts.declared_successes = truth::DeclaredSuccess(outcome) ? 1 : 0;
  return counts;
}

}  // namespace

PrefixCounts& PrefixCounts::operator+=(const PrefixCounts& other) {
  trials += other.trials;
  faults += other.faults;
  measured += other.measured;
  declared_successes += other.declared_successes;
  return *this;
}

bool PrefixCounter::Add(std::int64_t trial, truth::TrialOutcome outcome) {
  EXPECT(trial >= 0);
  if (Has(trial)) return false;
  const auto index = static_cast<std::size_t>(trial);
  if (index >= outcomes_.size()) outcomes_.resize(index + 1, kPending);
  outcomes_[index] = static_cast<std::int8_t>(outcome);
  ++finished_.trials;
  if (outcome == truth::TrialOutcome::kSimulatorFault) ++finished_.faults;
  std::int64_t prefix_end = prefix_.trials;
  while (Has(prefix_end)) ++prefix_end;
  prefix_ += Count(prefix_.trials, prefix_end);
  return true;
}

bool PrefixCounter::Has(std::int64_t trial) const {
  return trial < end() && outcomes_[static_cast<std::size_t>(trial)] != kPending;
}

FinishedCounts PrefixCounter::Finished(std::int64_t to) const {
  if (to >= end()) return finished_;
  FinishedCounts counts;
  for (std::int64_t trial = 0; trial < to; ++trial) {
    if (!Has(trial)) continue;
    ++counts.trials;
    counts.faults += Count(trial, trial + 1).faults;
  }
  return counts;
}

PrefixCounts PrefixCounter::Count(std::int64_t from, std::int64_t to) const {
  PrefixCounts counts;
  for (std::int64_t trial = from; trial < to; ++trial) {
    EXPECT(Has(trial));
    const auto outcome = outcomes_[static_cast<std::size_t>(trial)];
    counts += CountOf(static_cast<truth::TrialOutcome>(outcome));
  }
  return counts;
}

}  // namespace rockyard::batch
