// How verdicts are computed, on synthetic trials whose law is known. No published verdict is
// asserted.
#include <gtest/gtest.h>

#include <algorithm>

#include "statistics/published_comparison.h"
#include "statistics/sample_statistics.h"
#include "synthetic_trials.h"

namespace rockyard::statistics {
namespace {

using truth::TrialOutcome;

PublishedValue Value(std::string id, StatisticKind statistic, std::int64_t n, double value,
                     std::string column = "") {
  PublishedValue published;
  published.id = std::move(id);
  published.what = published.id;
  published.scenario = "nominal";
  published.statistic = statistic;
  published.sample_size = n;
  published.value = value;
  published.column = std::move(column);
  if (statistic == StatisticKind::kOutcomeCount) {
    published.outcomes = {TrialOutcome::kGoalReached, TrialOutcome::kFalseGoal};
  }
  return published;
}

std::vector<double> Sorted(const std::vector<truth::Record>& records, std::size_t column) {
  std::vector<double> values;
  for (const truth::Record& r : records) values.push_back(r.values[column]);
  return SortedFinite(values);
}

// What a paper would print of one set of trials.
PublishedReference Publish(const std::vector<truth::Record>& set) {
  const auto n = static_cast<std::int64_t>(set.size());
  const auto reached = std::count_if(set.begin(), set.end(), [](const truth::Record& r) {
    return truth::DeclaredSuccess(r.outcome);
  });
  const std::vector<double> distance = Sorted(set, 0);
  const std::vector<double> error = Sorted(set, 2);
  const auto negative = std::count_if(error.begin(), error.end(), [](double x) { return x < 0.0; });
  PublishedReference reference{.title = "synthetic"};
  using enum StatisticKind;
  reference.values = {
      Value("success", kOutcomeCount, n, static_cast<double>(reached)),
      Value("min", kMinimum, n, distance.front(), "true_distance_m"),
      Value("mode", kMode, n, HalfSampleMode(distance), "true_distance_m"),
      Value("max", kMaximum, n, error.back(), "distance_error_percent"),
      Value("negative", kNegativeCount, n, static_cast<double>(negative), "distance_error_percent"),
  };
  return reference;
}

ComparisonResult CompareSets(const SyntheticLaw& simulated, const SyntheticLaw& real,
                             std::uint64_t seed, std::uint32_t pool = 300) {
  const auto trials = SyntheticTrials(simulated, seed, pool);
  const std::vector<ScenarioRun> runs = {RunOf("nominal", trials)};
  return Compare(Publish(SyntheticTrials(real, seed + 100000, 40)), runs,
                 {.seed = seed, .replicates = 500});
}

TEST(Verdicts, FamilyWiseFalseAlarmsStayBelowAlpha) {
  constexpr int kFamilies = 100;
  int alarms = 0;
  for (std::uint64_t seed = 0; seed < kFamilies; ++seed) {
    alarms += ExitCode(CompareSets({}, {}, seed)) == 1 ? 1 : 0;
  }
  // 0.05 plus 3 sigma of 100 families.
  EXPECT_LE(alarms, 0.05 * kFamilies + 3.0 * std::sqrt(0.05 * 0.95 * kFamilies));
}

TEST(Verdicts, AWrongSimulationIsFound) {
  constexpr int kFamilies = 15;
  int success_found = 0;
  int minimum_found = 0;
  for (std::uint64_t seed = 0; seed < kFamilies; ++seed) {
    const ComparisonResult few = CompareSets({.success_rate = 0.6}, {.success_rate = 0.98}, seed);
    success_found += few.values[0].verdict == Verdict::kDiffers ? 1 : 0;
    EXPECT_EQ(ExitCode(few), few.values[0].verdict == Verdict::kDiffers ? 1 : ExitCode(few));
    const ComparisonResult far = CompareSets({.shortest_m = 7.6}, {.shortest_m = 7.0}, seed);
    minimum_found += far.values[1].verdict == Verdict::kDiffers ? 1 : 0;
  }
  EXPECT_GE(success_found, 0.9 * kFamilies);
  EXPECT_GE(minimum_found, 0.9 * kFamilies);
}

ComparedValue CompareOneValue(const PublishedValue& value, const std::vector<ScenarioRun>& runs,
                              std::size_t replicates = 2000) {
  PublishedReference reference{.values = {value}};
  return Compare(reference, runs, {.seed = 1, .replicates = replicates}).values[0];
}

Verdict SuccessVerdict(std::int64_t n, double value, double rate, std::uint32_t pool = 2000) {
  return CompareOneValue(Value("success", StatisticKind::kOutcomeCount, n, value),
                         {RunOf("nominal", SyntheticTrials({.success_rate = rate}, 5, pool))}, 100)
      .verdict;
}

TEST(Verdicts, SixRunsAreUnderpoweredFortyAreNot) {
  EXPECT_EQ(SuccessVerdict(6, 6, 0.97), Verdict::kUnderpowered);
  EXPECT_EQ(SuccessVerdict(12, 12, 0.97), Verdict::kUnderpowered);
  EXPECT_EQ(SuccessVerdict(40, 39, 0.97), Verdict::kAgrees);
  EXPECT_EQ(SuccessVerdict(40, 30, 0.97), Verdict::kDiffers);
  EXPECT_EQ(SuccessVerdict(6, 1, 0.97), Verdict::kDiffers);
}

// A mode far from any simulated one is shown, and in no family.
TEST(Verdicts, ModesAreNotJudged) {
  const auto trials = SyntheticTrials({}, 5, 300);
  const std::vector<ScenarioRun> runs = {RunOf("nominal", trials)};
  PublishedReference reference;
  reference.values = {Value("mode", StatisticKind::kMode, 40, 99.0, "true_distance_m")};
  const ComparisonResult result = Compare(reference, runs, {.seed = 1, .replicates = 100});
  const ComparedValue& mode = result.values[0];
  EXPECT_EQ(mode.verdict, Verdict::kNotJudged);
  EXPECT_EQ(result.family, 0U);
  EXPECT_TRUE(std::isnan(mode.p_value));
  EXPECT_LT(mode.interval.low, mode.interval.high);
  EXPECT_NE(mode.remark.find("no coverage claimed"), std::string::npos);
  EXPECT_EQ(ExitCode(result), 4);
}

TEST(Rows, MissingRunsColumnsAndTrialsAreNotJudged) {
  const std::vector<truth::Record> none;
  const auto trials = SyntheticTrials({}, 5, 10);
  const PublishedValue success = Value("s", StatisticKind::kOutcomeCount, 6, 6);
  const PublishedValue minimum = Value("m", StatisticKind::kMinimum, 6, 6, "true_distance_m");
  const PublishedValue unknown = Value("u", StatisticKind::kMinimum, 6, 6, "no_such_column");
  EXPECT_EQ(CompareOneValue(success, {}).verdict, Verdict::kNotJudged);
  EXPECT_EQ(CompareOneValue(success, {RunOf("nominal", none)}).verdict, Verdict::kNotJudged);
  EXPECT_EQ(CompareOneValue(minimum, {RunOf("nominal", none)}).verdict, Verdict::kNotJudged);
  EXPECT_EQ(CompareOneValue(unknown, {RunOf("nominal", trials)}).verdict, Verdict::kNotJudged);
  EXPECT_FALSE(CompareOneValue(unknown, {RunOf("nominal", trials)}).remark.empty());
}

TEST(Rows, SimulatorFaultsCountNowhere) {
  auto trials = SyntheticTrials({.success_rate = 1.0}, 5, 100);
  truth::Record fault;
  fault.outcome = TrialOutcome::kSimulatorFault;
  trials.insert(trials.begin(), 50, fault);
  const ComparedValue row =
      CompareOneValue(Value("s", StatisticKind::kOutcomeCount, 6, 6), {RunOf("nominal", trials)});
  EXPECT_EQ(row.pool, 100);
  EXPECT_EQ(row.pool_value, 1.0);
}

PublishedValue Kinds(std::int64_t jams, std::int64_t no_paths) {
  PublishedValue value = Value("kinds", StatisticKind::kFailureKinds, jams + no_paths, NAN);
  value.kinds = {{"jammed", {TrialOutcome::kJammed, TrialOutcome::kEnergyDepleted}, jams},
                 {"no path", {TrialOutcome::kNoPath}, no_paths}};
  return value;
}

TEST(Rows, KindsOfFailure) {
  const auto trials = SyntheticTrials({.success_rate = 0.5, .jam_share = 0.95}, 5, 2000);
  const std::vector<ScenarioRun> runs = {RunOf("nominal", trials)};
  EXPECT_EQ(CompareOneValue(Kinds(1, 1), runs).verdict, Verdict::kUnderpowered);
  // Six failures without a path, where 95 % of the simulated ones are jams.
  EXPECT_EQ(CompareOneValue(Kinds(0, 6), runs).verdict, Verdict::kDiffers);
  const ComparedValue likely = CompareOneValue(Kinds(6, 0), runs);
  EXPECT_NEAR(likely.p_value, 1.0, 1e-9);
  EXPECT_EQ(likely.kinds.size(), 3u);
  EXPECT_EQ(likely.kinds[2].simulated, 0);
}

TEST(Rows, ExponentialStatementCanOnlyContradict) {
  const PublishedValue value =
      Value("tail", StatisticKind::kExponentialTail, 40, NAN, "true_distance_m");
  const auto exponential = SyntheticTrials({}, 5, 300);
  EXPECT_EQ(CompareOneValue(value, {RunOf("nominal", exponential)}).verdict,
            Verdict::kUnderpowered);
  auto bimodal = exponential;
  for (std::size_t i = 0; i < bimodal.size(); ++i) bimodal[i].values[0] = i % 2 == 0 ? 8.0 : 12.0;
  for (std::size_t i = 0; i < bimodal.size(); ++i) {
    bimodal[i].values[0] += 0.001 * static_cast<double>(i);
  }
  EXPECT_EQ(CompareOneValue(value, {RunOf("nominal", bimodal)}).verdict, Verdict::kDiffers);
}

TEST(Rows, LowerBoundIsGeometry) {
  const PublishedValue value =
      Value("bound", StatisticKind::kLowerBound, 300, 7.6, "true_distance_m");
  const auto possible = SyntheticTrials({.shortest_m = 7.5}, 5, 300);
  const auto impossible = SyntheticTrials({.shortest_m = 7.3}, 5, 300);
  EXPECT_EQ(CompareOneValue(value, {RunOf("nominal", possible)}).verdict, Verdict::kHolds);
  EXPECT_EQ(CompareOneValue(value, {RunOf("nominal", impossible)}).verdict, Verdict::kDiffers);
  ScenarioRun wide = RunOf("nominal", impossible);
  wide.goal_tolerance_m = 0.5;
  EXPECT_EQ(CompareOneValue(value, {wide}).verdict, Verdict::kHolds);
  EXPECT_TRUE(std::isnan(CompareOneValue(value, {wide}).p_value));
}

TEST(Rows, OffsetOfMediansIsShownNotJudged) {
  PublishedValue value = Value("offset", StatisticKind::kMedianOffset, 40, NAN, "true_distance_m");
  value.other_scenario = "perfect";
  value.other_sample_size = 300;
  const auto near = SyntheticTrials({.shortest_m = 7.0}, 5, 2000);
  const auto far = SyntheticTrials({.shortest_m = 7.6}, 6, 2000);
  const ComparedValue row = CompareOneValue(value, {RunOf("nominal", near), RunOf("perfect", far)});
  EXPECT_EQ(row.verdict, Verdict::kNotJudged);
  EXPECT_NEAR(row.median, -0.6, 0.15);
  EXPECT_LT(row.interval.low, -0.6);
  EXPECT_GT(row.interval.high, -0.6);
}

TEST(Rows, LayoutColumnGivesAMeasuredPValue) {
  auto trials = SyntheticTrials({.success_rate = 0.9}, 5, 400);
  auto schema = SyntheticSchema();
  schema.push_back({"layout", "1", "rock layout"});
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const std::size_t layout = i / 10;
    trials[i].values.push_back(static_cast<double>(layout));
    // One layout in ten defeats the rover, the others do not: the layout decides all.
    trials[i].outcome = layout % 10 == 0 ? TrialOutcome::kNoPath : TrialOutcome::kGoalReached;
  }
  ScenarioRun run{.scenario = "nominal", .schema = schema, .records = trials};
  const PublishedValue none = Value("s", StatisticKind::kOutcomeCount, 6, 0);
  const ComparedValue row = CompareOneValue(none, {run});
  ASSERT_TRUE(row.one_layout.has_value());
  EXPECT_TRUE(row.one_layout->measured);
  // 0 of 6 is next to impossible for independent layouts, a tenth of all cases for one layout.
  EXPECT_LT(row.p_value, 1e-4);
  EXPECT_NEAR(row.one_layout->p_value.low, 0.2, 0.08);
}

TEST(ExitCode, FollowsTheVerdicts) {
  ComparisonResult result;
  EXPECT_EQ(ExitCode(result), 4);
  const auto with = [&](std::initializer_list<Verdict> verdicts) {
    result.values.clear();
    for (const Verdict v : verdicts) result.values.emplace_back().verdict = v;
    return ExitCode(result);
  };
  EXPECT_EQ(with({Verdict::kAgrees, Verdict::kNotJudged}), 0);
  EXPECT_EQ(with({Verdict::kAgrees, Verdict::kUnderpowered}), 4);
  EXPECT_EQ(with({Verdict::kHolds, Verdict::kNotJudged}), 0);
  EXPECT_EQ(with({Verdict::kHolds, Verdict::kDiffers}), 1);
  EXPECT_EQ(with({Verdict::kUnderpowered, Verdict::kDiffers}), 1);
  EXPECT_EQ(with({Verdict::kNotJudged}), 4);
}

}  // namespace
}  // namespace rockyard::statistics
