// How far trials got, as distribution functions.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "statistics/cumulative_incidence.h"
#include "statistics/sample_statistics.h"
#include "truth/record.h"

namespace rockyard::report {

// At one distinct true distance.
struct DistanceStep {
  statistics::EcdfPoint all;       // of the distance of all runs, however they ended
  statistics::IncidenceStep goal;  // declared arrival, failures competing
  double limit = 0.0;              // share of all that a limit of the run ended so far
  std::size_t at_risk = 0;         // just before
};

// Over all trials without a simulator fault, ascending; none where the records have no
// true_distance_m. Cost: n log n.
std::vector<DistanceStep> DistanceSteps(const truth::RecordSchema& schema,
                                        std::span<const truth::Record> records);

}  // namespace rockyard::report
