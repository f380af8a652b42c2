// What baseline files call things. For baseline*.cc only.
#pragma once

#include <string_view>

#include "truth/record.h"

namespace rockyard::report {

inline constexpr std::string_view kBaselineKind = "rockyard_baseline";

// In the order of truth::TrialOutcome.
inline constexpr std::string_view kOutcomeLetters = "GFTHJNELAXMS";
static_assert(kOutcomeLetters.size() == truth::kTrialOutcomeNames.size());

}  // namespace rockyard::report
