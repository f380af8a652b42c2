#include "batch/prefix_counter.h"

#include "core/check.h"

namespace rockyard::batch {

void PrefixCounter::Add(std::int64_t trial, truth::TrialOutcome outcome) {
  EXPECT(trial >= 0);
  const auto index = static_cast<std::size_t>(trial);
  if (index >= outcomes_.size()) outcomes_.resize(index + 1, kPending);
  EXPECT(outcomes_[index] == kPending);
  outcomes_[index] = static_cast<std::int8_t>(outcome);
  ++finished_;
  if (outcome == truth::TrialOutcome::kSimulatorFault) ++faults_;

  for (auto next = static_cast<std::size_t>(prefix_.trials);
       next < outcomes_.size() && outcomes_[next] != kPending; ++next) {
    const auto kind = static_cast<truth::TrialOutcome>(outcomes_[next]);
    ++prefix_.trials;
    if (kind == truth::TrialOutcome::kSimulatorFault) ++prefix_.faults;
    if (kind == truth::TrialOutcome::kMeasured) ++prefix_.measured;
    if (truth::DeclaredSuccess(kind)) ++prefix_.declared_successes;
  }
}

}  // namespace rockyard::batch
