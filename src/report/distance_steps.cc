#include "report/distance_steps.h"

#include "statistics/drive_summary.h"

namespace rockyard::report {

std::vector<DistanceStep> DistanceSteps(const truth::RecordSchema& schema,
                                        std::span<const truth::Record> records) {
  std::vector<DistanceStep> distances;
  const auto column = statistics::ColumnIndex(schema, "true_distance_m");
  if (!column) return distances;
  const std::vector<double> values = statistics::ColumnValues(records, *column);
  const auto durations = statistics::GoalDurations(records, *column);
  const auto steps = statistics::CumulativeIncidence(durations);

  // Before the first step nothing has happened.
  statistics::IncidenceStep now;
  std::size_t next = 0;
  std::size_t passed = 0;
  const std::vector<double> sorted = statistics::SortedFinite(values);
  for (const statistics::EcdfPoint& point : statistics::Ecdf(values)) {
    while (next < steps.size() && steps[next].at <= point.value) now = steps[next++];
    distances.push_back({.all = point, .goal = now, .at_risk = sorted.size() - passed});
    while (passed < sorted.size() && sorted[passed] <= point.value) ++passed;
  }
  return distances;
}

}  // namespace rockyard::report
