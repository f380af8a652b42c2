#include "report/trial_outcomes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/check.h"
#include "statistics/drive_summary.h"

namespace rockyard::report {

using statistics::CountOfRun;
using truth::Record;

CellOutcomes::CellOutcomes(std::span<const Record> records, std::int64_t per_layout)
    : per_layout_(static_cast<std::size_t>(per_layout)) {
  EXPECT(per_layout >= 1);
  outcomes_.reserve(records.size());
  for (const Record& record : records) {
    outcomes_.push_back(static_cast<std::uint8_t>(record.outcome));
  }
}

bool CellOutcomes::Succeeded(std::size_t trial, SuccessKind kind) const {
  return kind == SuccessKind::kDeclared ? truth::DeclaredSuccess(Outcome(trial))
                                        : Outcome(trial) == truth::TrialOutcome::kGoalReached;
}

std::vector<std::size_t> CellOutcomes::Groups() const {
  std::vector<std::size_t> groups;
  for (std::size_t i = 0; SharesLayouts() && i < size(); ++i) groups.push_back(i / per_layout_);
  return groups;
}

std::vector<CountOfRun> CellOutcomes::ByLayout(SuccessKind kind) const {
  std::vector<CountOfRun> layouts((size() + per_layout_ - 1) / per_layout_);
  for (std::size_t trial = 0; trial < size(); ++trial) {
    if (IsFault(trial)) continue;
    CountOfRun& layout = layouts[trial / per_layout_];
    layout.count += Succeeded(trial, kind) ? 1.0 : 0.0;
    layout.base += 1.0;
  }
  std::erase_if(layouts, [](const CountOfRun& layout) { return layout.base == 0.0; });
  return layouts;
}

std::vector<Record> CellOutcomes::Records() const {
  std::vector<Record> records;
  records.reserve(size());
  for (std::size_t trial = 0; trial < size(); ++trial) {
    records.push_back({trial, Outcome(trial), {}, {}});
  }
  return records;
}

namespace {

using truth::TrialOutcome;

// Whether the trial can be driven again to be looked at.
bool CanBeShown(const truth::Record& record) {
  return !truth::IsFault(record) && record.outcome != TrialOutcome::kMeasured &&
         !truth::IsNavigatorCrash(record);
}

bool Failed(const truth::Record& record) {
  return CanBeShown(record) && record.outcome != TrialOutcome::kGoalReached;
}

using Ended = std::vector<std::pair<double, std::uint64_t>>;  // distance and number of each trial

double DistanceOf(const truth::Record& record, std::optional<std::size_t> column) {
  if (!column || *column >= record.values.size()) return 0.0;
  const double distance_m = record.values[*column];
  return std::isfinite(distance_m) ? distance_m : std::numeric_limits<double>::infinity();
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

std::vector<std::uint64_t> ExampleTrials(const truth::RecordSchema& schema,
                                         std::span<const truth::Record> records) {
  const auto column = statistics::ColumnIndex(schema, "true_distance_m");
  std::array<Ended, truth::kTrialOutcomeNames.size()> by_outcome;
  for (const truth::Record& record : records) {
    if (!CanBeShown(record)) continue;
    by_outcome[static_cast<std::size_t>(record.outcome)].emplace_back(DistanceOf(record, column),
                                                                      record.trial);
  }
  std::stable_sort(by_outcome.begin(), by_outcome.end(),
                   [](const Ended& a, const Ended& b) { return a.size() > b.size(); });
  std::vector<std::uint64_t> trials;
  for (Ended& ended : by_outcome) {
    if (ended.empty()) continue;
    const auto middle = ended.begin() + static_cast<std::ptrdiff_t>((ended.size() - 1) / 2);
    std::nth_element(ended.begin(), middle, ended.end());
    trials.push_back(middle->second);
  }
  return trials;
}

}  // namespace rockyard::report
