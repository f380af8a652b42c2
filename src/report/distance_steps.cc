#include "report/distance_steps.h"

#include <algorithm>

#include "statistics/clustered_rate.h"
#include "statistics/drive_summary.h"
#include "truth/end_cause.h"

namespace rockyard::report {

std::vector<DistanceStep> DistanceSteps(const truth::RecordSchema& schema,
                                        std::span<const truth::Record> records) {
  std::vector<DistanceStep> distances;
  const auto column = statistics::ColumnIndex(schema, "true_distance_m");
  if (!column) return distances;
  const std::vector<double> values = statistics::ColumnValues(records, *column);
  const auto durations = statistics::GoalDurations(records, *column);
  // Of trials that share layouts each layout says as much as one trial, whatever their dependence.
  const std::vector<std::size_t> groups = statistics::DependentGroups(schema, records);
  const auto layouts =
      groups.empty() ? static_cast<double>(records.size())
                     : 1.0 + static_cast<double>(*std::max_element(groups.begin(), groups.end()));
  const double share = records.empty() ? 1.0 : layouts / static_cast<double>(records.size());
  const auto steps = statistics::CumulativeIncidence(durations, statistics::kConfidence, share);

  std::vector<double> limits;
  for (const truth::Record& record : records) {
    if (*column < record.values.size() && truth::EndedByLimit(record)) {
      limits.push_back(record.values[*column]);
    }
  }
  limits = statistics::SortedFinite(limits);

  // Before the first step nothing has happened.
  statistics::IncidenceStep now;
  std::size_t next = 0;
  std::size_t passed = 0;
  const std::vector<double> sorted = statistics::SortedFinite(values);
  for (const statistics::EcdfPoint& point :
       statistics::Ecdf(values, statistics::kConfidence, statistics::BandMethod::kSimultaneous,
                        share * static_cast<double>(sorted.size()))) {
    while (next < steps.size() && steps[next].at <= point.value) now = steps[next++];
    const auto ended = std::upper_bound(limits.begin(), limits.end(), point.value);
    distances.push_back(
        {.all = point,
         .goal = now,
         .limit = static_cast<double>(ended - limits.begin()) / static_cast<double>(sorted.size()),
         .at_risk = sorted.size() - passed});
    while (passed < sorted.size() && sorted[passed] <= point.value) ++passed;
  }
  return distances;
}

}  // namespace rockyard::report
