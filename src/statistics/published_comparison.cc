#include "statistics/published_comparison.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/numbers.h"
#include "statistics/compare_rows.h"
#include "statistics/multiple_testing.h"

namespace rockyard::statistics {
namespace {

const ScenarioRun* FindRun(std::span<const ScenarioRun> runs, const std::string& scenario) {
  const auto found = std::find_if(runs.begin(), runs.end(),
                                  [&](const ScenarioRun& run) { return run.scenario == scenario; });
  return found == runs.end() ? nullptr : &*found;
}

Row CompareOne(const PublishedValue& published, std::span<const ScenarioRun> runs,
               const ComparisonOptions& options) {
  if (published.statistic == StatisticKind::kComputed) return CompareComputed(published);
  const ScenarioRun* run = FindRun(runs, published.scenario);
  if (run == nullptr) return NotJudged(published, "no run of " + published.scenario);
  switch (published.statistic) {
    case StatisticKind::kOutcomeCount:
      return CompareOutcomeCount(published, *run, options);
    case StatisticKind::kFailureKinds:
      return CompareFailureKinds(published, *run);
    case StatisticKind::kNegativeCount:
      return CompareNegativeCount(published, *run);
    case StatisticKind::kMinimum:
    case StatisticKind::kMaximum:
    case StatisticKind::kMode:
      return CompareSampleStatistic(published, *run, options);
    case StatisticKind::kExponentialTail:
      return CompareExponentialTail(published, *run, options);
    case StatisticKind::kLowerBound:
      return CompareLowerBound(published, *run, options);
    case StatisticKind::kMedianOffset: {
      const ScenarioRun* other = FindRun(runs, published.other_scenario);
      if (other == nullptr) return NotJudged(published, "no run of " + published.other_scenario);
      return CompareMedianOffset(published, *run, *other, options);
    }
    case StatisticKind::kRate:
    case StatisticKind::kRatio:
    case StatisticKind::kRatioSum:
    case StatisticKind::kMean:
    case StatisticKind::kCrossing:
      return CompareTolerance(published, *run);
    case StatisticKind::kComputed:
      break;
  }
  return NotJudged(published, "unknown statistic");
}

// Fills in what depends on the whole family of Holm's procedure.
void Judge(std::vector<Row>& rows, double alpha) {
  std::vector<Row*> family;
  std::vector<double> p_values;
  for (Row& row : rows) {
    if (!row.power) continue;
    family.push_back(&row);
    p_values.push_back(row.value.p_value);
  }
  const std::vector<double> adjusted = HolmAdjust(p_values);
  const std::vector<double> levels = HolmLevels(p_values, alpha);
  for (std::size_t i = 0; i < family.size(); ++i) {
    ComparedValue& value = family[i]->value;
    value.holm_p_value = adjusted[i];
    value.level = levels[i];
    value.power = family[i]->power(value.level);
    value.verdict = adjusted[i] <= alpha            ? Verdict::kDiffers
                    : value.power >= kRequiredPower ? Verdict::kAgrees
                                                    : Verdict::kUnderpowered;
  }
}

// The verdict inside of the tolerance: kHolds where nothing lies outside of it, as a rate cannot
// leave [0, 1].
Verdict InsideVerdict(const PublishedValue& published) {
  const bool rate = published.statistic == StatisticKind::kRate;
  const bool all = published.low <= (rate ? 0.0 : -core::kInfinity) &&
                   published.high >= (rate ? 1.0 : core::kInfinity);
  return all ? Verdict::kHolds : Verdict::kAgrees;
}

// Judges rows with a tolerance. Bonferroni: all intervals hold together with 1 - alpha, whatever
// their dependence.
void JudgeTolerances(std::vector<Row>& rows, double alpha) {
  const auto family = std::count_if(rows.begin(), rows.end(),
                                    [](const Row& row) { return row.interval != nullptr; });
  for (Row& row : rows) {
    if (!row.interval) continue;
    ComparedValue& value = row.value;
    value.level = alpha / static_cast<double>(family);
    value.interval = row.interval(1.0 - value.level);
    const double low = value.published.low;
    const double high = value.published.high;
    const bool inside = value.interval.low >= low && value.interval.high <= high;
    const bool apart = value.interval.high < low || value.interval.low > high;
    value.verdict = apart     ? Verdict::kDiffers
                    : !inside ? Verdict::kUnderpowered
                              : InsideVerdict(value.published);
  }
}

}  // namespace

Row NotJudged(const PublishedValue& published, std::string remark) {
  Row row;
  row.value.published = published;
  row.value.remark = std::move(remark);
  return row;
}

const char* Name(Verdict verdict) {
  // Must stay in the order of Verdict.
  constexpr const char* kNames[] = {"agrees", "holds", "differs", "underpowered", "not judged"};
  return kNames[static_cast<std::size_t>(verdict)];
}

ComparisonResult Compare(const PublishedReference& reference, std::span<const ScenarioRun> runs,
                         const ComparisonOptions& options) {
  EXPECT(options.replicates >= 100 && options.alpha > 0.0 && options.alpha < 1.0);
  std::vector<Row> rows;
  for (const PublishedValue& published : reference.values) {
    rows.push_back(CompareOne(published, runs, options));
  }
  Judge(rows, options.alpha);
  JudgeTolerances(rows, options.alpha);
  ComparisonResult result{.options = options, .family = 0, .values = {}};
  for (Row& row : rows) {
    if (row.power) ++result.family;
    result.values.push_back(std::move(row.value));
  }
  for (const ScenarioRun& run : runs) {
    if (!run.other_settings.empty()) result.changed.push_back({run.scenario, run.other_settings});
  }
  return result;
}

const OtherSettings* ComparisonResult::FindChanged(std::string_view scenario) const {
  const auto found = std::find_if(changed.begin(), changed.end(), [&](const OtherSettings& other) {
    return other.scenario == scenario;
  });
  return found == changed.end() ? nullptr : &*found;
}

int ExitCode(const ComparisonResult& result) {
  constexpr int kAllAgree = 0;
  constexpr int kSomethingDiffers = 1;
  constexpr int kInconclusive = 4;
  const auto has = [&](Verdict verdict) {
    return std::any_of(result.values.begin(), result.values.end(),
                       [&](const ComparedValue& value) { return value.verdict == verdict; });
  };
  if (has(Verdict::kDiffers)) return kSomethingDiffers;
  const bool judged = has(Verdict::kAgrees) || has(Verdict::kHolds);
  return has(Verdict::kUnderpowered) || !judged ? kInconclusive : kAllAgree;
}

}  // namespace rockyard::statistics
