// Cumulative incidence with competing risks (Aalen and Johansen 1978).
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
  double at = 0.0;  // distance driven (or time) at the end, >= 0
  EndKind kind = EndKind::kCensored;
};

// A step of both incidences: at and beyond `at` they hold until the next step.
struct IncidenceStep {
  double at = 0.0;
  double event = 0.0;           // probability to have had the event
  double competing = 0.0;       // probability to have had the competing one
  double standard_error = 0.0;  // of `event`
  // Pointwise. As long as nothing was censored the incidence is a rate, and this its exact interval
  // (Clopper and Pearson 1934); beyond on the log(-log) scale, at 0 and 1 exact.
  Interval band;
  std::int64_t at_risk = 0;  // just before `at`
};

// Returns the Aalen-Johansen estimate, one step per distinct distance with an event or a competing
// event. The variance is by the delta method (Marubini and Valsecchi 1995, eq. 10.12). As long
// as nothing was censored the incidences are the counts over all trials, to the last bit, and the
// variance is the binomial one. Entries whose distance is not finite are left out. Where they hang
// together, bands are those of `share` times as many. Cost: n log n.
std::vector<IncidenceStep> CumulativeIncidence(std::span<const Duration> durations,
                                               double confidence = kConfidence, double share = 1.0);

// How a trial's end counts when the event is reaching the goal: believed arrival is the event (or
// true arrival only), a simulator fault is no observation, all else competes. A time limit competes
// too: it is a condition of the scenario, what it ends has not arrived, and it ends the slow and
// the lost, so that to leave them out of those at risk would be to assume that they would arrive as
// the others do. So the curve ends at the success rate.
enum class Success { kDeclared, kTrue };
std::vector<Duration> GoalDurations(std::span<const truth::Record> records, std::size_t column,
                                    Success success = Success::kDeclared);

}  // namespace rockyard::statistics
