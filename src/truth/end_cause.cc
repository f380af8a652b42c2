#include "truth/end_cause.h"

#include <algorithm>

namespace rockyard::truth {

std::optional<EndCause> CauseOf(TrialOutcome outcome, std::string_view detail) {
  for (std::size_t i = 0; i < kEndCauses.size(); ++i) {
    const EndCauseInfo& info = kEndCauses[i];
    if (info.outcome != outcome || !detail.starts_with(info.sentence)) continue;
    const std::string_view rest = detail.substr(info.sentence.size());
    const bool told = outcome == TrialOutcome::kNavigatorFault && rest.starts_with(": ");
    if (rest.empty() || told) return static_cast<EndCause>(i);
  }
  return std::nullopt;
}

bool EndedByLimit(const Record& record) {
  // kTimeLimit has one cause: records whose sentence is of another version have it too.
  if (record.outcome == TrialOutcome::kTimeLimit) return true;
  const auto cause = CauseOf(record);
  return cause && IsLimit(*cause);
}

std::string_view CauseName(const Record& record) {
  const auto cause = CauseOf(record);
  return cause ? Info(*cause).name : std::string_view();
}

bool HasSeveralCauses(TrialOutcome outcome) {
  return std::count_if(kEndCauses.begin(), kEndCauses.end(),
                       [&](const EndCauseInfo& info) { return info.outcome == outcome; }) > 1;
}

}  // namespace rockyard::truth
