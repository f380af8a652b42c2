// Cumulative incidence with competing risks (Aalen and Johansen 1978): the share of drives that
// have reached the goal by a distance. distance_cdf.csv and the report page show it. No record,
// verdict or exit code depends on it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "statistics/proportions.h"
#include "truth/record.h"

namespace rockyard::statistics {

// How one trial's way ended.
enum class EndKind {
  kEvent,      // reached the goal
  kCompeting,  // failed: will never reach it
  kCensored,   // stopped for an administrative reason; what would have followed is unknown
};

struct Duration {
  double at = 0.0;  // distance driven (or time) at the end, >= 0; infinite where unknown
  EndKind kind = EndKind::kCensored;
};

// A step of both incidences: at and beyond `at` they hold until the next step.
struct IncidenceStep {
  double at = 0.0;
  double event = 0.0;           // probability to have had the event
  double competing = 0.0;       // probability to have had the competing one
  double standard_error = 0.0;  // of `event`
  // The pointwise band of `event`. As long as nothing was censored the incidence is a rate, and the
  // band its exact interval (Clopper and Pearson 1934). Later it is on the log(-log) scale, and
  // exact again where the incidence is 0 or 1.
  Interval band;
  std::int64_t at_risk = 0;  // just before `at`
};

// Returns the Aalen-Johansen estimate, one step per distinct distance with an event or a competing
// event. The variance is by the delta method (Marubini and Valsecchi 1995, eq. 10.12). As long as
// nothing was censored the incidences are the counts over all trials, to the last bit, and the
// variance is the binomial one. Entries whose distance is not a number are left out; those at
// infinity are at risk throughout and end in a step of their own, the last. Where entries
// hang together, `share` is below 1: bands and standard errors are those of `share` times as many
// entries. Cost: n log n.
std::vector<IncidenceStep> CumulativeIncidence(std::span<const Duration> durations,
                                               double confidence = kConfidence, double share = 1.0);

// Which arrival is the event: every believed one, or the true one only.
enum class Success { kDeclared, kTrue };

// Returns the ends of trials where the event is reaching the goal; `column` has the distance
// driven. A simulator fault is no observation, all else competes. A time limit competes too: it is
// a condition of the scenario, and it ends the slow and the lost, so that to censor them would be
// to assume that they would arrive as the others do. So the curve ends at the success rate. A trial
// that did not arrive and whose distance is not known (truth::IsNavigatorCrash) ends at infinity:
// it counts among those that could have arrived, wherever it ended.
std::vector<Duration> GoalDurations(std::span<const truth::Record> records, std::size_t column,
                                    Success success = Success::kDeclared);

}  // namespace rockyard::statistics
