#include "report/worst_trials.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "statistics/drive_summary.h"

namespace rockyard::report {
namespace {

bool Failed(const truth::Record& record) {
  return !truth::IsFault(record) && record.outcome != truth::TrialOutcome::kGoalReached &&
         record.outcome != truth::TrialOutcome::kMeasured;
}

}  // namespace

double GoalDistanceOrInfinity(const truth::Record& record, std::optional<std::size_t> column) {
  constexpr double kUnknown_m = std::numeric_limits<double>::infinity();
  if (!column || *column >= record.values.size()) return kUnknown_m;
  const double distance_m = record.values[*column];
  return std::isfinite(distance_m) ? distance_m : kUnknown_m;
}

std::vector<std::uint64_t> FailedTrials(std::span<const truth::Record> records) {
  std::vector<std::uint64_t> trials;
  for (const truth::Record& record : records) {
    if (Failed(record)) trials.push_back(record.trial);
  }
  std::sort(trials.begin(), trials.end());
  return trials;
}

std::vector<std::uint64_t> WorstTrials(const truth::RecordSchema& schema,
                                       std::span<const truth::Record> records, std::size_t most) {
  struct Failure {
    std::uint64_t trial;
    double distance_m;
  };
  const auto column = statistics::ColumnIndex(schema, "true_goal_distance_m");
  std::vector<Failure> failures;
  for (const truth::Record& record : records) {
    if (!Failed(record)) continue;
    failures.push_back({record.trial, GoalDistanceOrInfinity(record, column)});
  }
  std::sort(failures.begin(), failures.end(), [](const Failure& a, const Failure& b) {
    return a.distance_m != b.distance_m ? a.distance_m > b.distance_m : a.trial < b.trial;
  });
  failures.resize(std::min(most, failures.size()));
  std::vector<std::uint64_t> trials;
  trials.reserve(failures.size());
  for (const Failure& failure : failures) trials.push_back(failure.trial);
  return trials;
}

}  // namespace rockyard::report
