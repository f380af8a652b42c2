#include "report/paired_comparison.h"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "core/says.h"
#include "statistics/equivalence.h"
#include "statistics/sample_statistics.h"

namespace rockyard::report {
namespace {

using testing::HasSubstr;
using truth::Record;
using truth::TrialOutcome;

// `both` pairs that succeed in both runs, and so on; the second run drives 0.5 m farther.
struct TwoRuns {
  TwoRuns(int both, int only_first, int only_second, int neither) {
    Add(both, TrialOutcome::kGoalReached, TrialOutcome::kGoalReached);
    Add(only_first, TrialOutcome::kGoalReached, TrialOutcome::kNoPath);
    Add(only_second, TrialOutcome::kJammed, TrialOutcome::kGoalReached);
    Add(neither, TrialOutcome::kNoPath, TrialOutcome::kNoPath);
  }
  void Add(int count, TrialOutcome first, TrialOutcome second) {
    for (int i = 0; i < count; ++i) {
      const std::uint64_t trial = a.size();
      const double distance = 7.0 + 0.01 * static_cast<double>(trial);
      a.push_back({trial, first, "", {distance, 1.0}});
      b.push_back({trial, second, "", {2.0, distance + 0.5}});
    }
  }
  RunComparison Compare(std::uint64_t seed_b = 1) const {
    return CompareRuns(First(), Second(seed_b));
  }
  ComparedRun First() const {
    return {"a", 1, {{"true_distance_m", "m", ""}, {"only_a", "1", ""}}, a, "rocks"};
  }
  ComparedRun Second(std::uint64_t seed = 1) const {
    return {"b", seed, {{"only_b", "1", ""}, {"true_distance_m", "m", ""}}, b, "rocks"};
  }

  std::vector<Record> a;
  std::vector<Record> b;
};

TEST(CompareRuns, PairsByIndexWhereSeedsAreTheSame) {
  const TwoRuns runs(30, 8, 1, 11);
  const RunComparison result = runs.Compare();
  EXPECT_TRUE(result.paired);
  EXPECT_EQ(result.pairs, 50);
  const SuccessComparison& success = result.successes[0];
  EXPECT_EQ(success.counts.only_first, 8);
  EXPECT_EQ(success.counts.only_second, 1);
  EXPECT_DOUBLE_EQ(success.difference, -0.14);
  EXPECT_DOUBLE_EQ(success.p_value, 2.0 * 10.0 / 512.0);  // 2 P(at most 1 of 9 heads)
  const statistics::Interval score = statistics::DifferenceInterval(success.counts);  // Tango 1998
  EXPECT_EQ(success.interval.low, score.low);
  EXPECT_EQ(success.interval.high, score.high);
  EXPECT_LT(success.interval.high, 0.0);
}

TEST(CompareRuns, ColumnsByNameWithPairedIntervals) {
  const RunComparison result = TwoRuns(40, 0, 0, 0).Compare();
  ASSERT_EQ(result.columns.size(), 1U) << "columns of both runs only";
  EXPECT_EQ(result.columns[0].name, "true_distance_m");
  EXPECT_NEAR(result.columns[0].difference, 0.5, 1e-12);
  // Every pair differs by 0.5 m: there is nothing to say how much others may differ.
  const statistics::Interval& interval = result.columns[0].interval;
  EXPECT_TRUE(std::isnan(interval.low) || interval.high - interval.low < 1e-9);
}

TEST(CompareRuns, OtherSeedsAreTwoSamples) {
  const TwoRuns runs(30, 8, 1, 11);
  const RunComparison result = runs.Compare(2);
  EXPECT_FALSE(result.paired);
  EXPECT_GT(result.successes[0].p_value, runs.Compare(1).successes[0].p_value);
  EXPECT_LT(result.columns[0].interval.low, result.columns[0].interval.high);
  EXPECT_NEAR(result.columns[0].difference, 0.5, 1e-12);
}

TEST(CompareRuns, FewUnpairedValuesHaveNoInterval) {
  TwoRuns runs(4, 0, 0, 0);
  runs.a.resize(2);
  runs.b.resize(2);
  for (std::size_t i = 0; i < 2; ++i) {
    runs.a[i].values.assign(runs.a[i].values.size(), static_cast<double>(i));
    runs.b[i].values.assign(runs.b[i].values.size(), static_cast<double>(i) + 3.0);
  }
  const statistics::Interval interval = runs.Compare(2).columns[0].interval;
  EXPECT_TRUE(std::isnan(interval.low));
  EXPECT_TRUE(std::isnan(interval.high));
  EXPECT_NEAR(runs.Compare(2).columns[0].difference, 3.0, 1e-12);
}

// Of two samples the interval is that of both means, put together; of pairs that of the
// differences.
TEST(CompareRuns, IntervalsOfMeansAreThoseOfAnyMean) {
  TwoRuns runs(40, 0, 0, 0);
  std::vector<double> first;
  std::vector<double> second;
  std::vector<double> differences;
  for (std::size_t i = 0; i < 40; ++i) {
    first.push_back(static_cast<double>(i));
    second.push_back(static_cast<double>(i + i * i));
    differences.push_back(second[i] - first[i]);
    runs.a[i].values.assign(runs.a[i].values.size(), first[i]);
    runs.b[i].values.assign(runs.b[i].values.size(), second[i]);
  }
  const statistics::Interval paired = runs.Compare().columns[0].interval;
  EXPECT_NEAR(paired.low, statistics::SkewedMeanInterval(differences).low, 1e-9);
  EXPECT_NEAR(paired.high, statistics::SkewedMeanInterval(differences).high, 1e-9);
  const RunComparison samples = runs.Compare(2);
  const statistics::Interval apart = statistics::MeanDifferenceInterval(
      samples.columns[0].first_mean, statistics::SkewedMeanInterval(first),
      samples.columns[0].second_mean, statistics::SkewedMeanInterval(second));
  EXPECT_NEAR(samples.columns[0].interval.low, apart.low, 1e-9);
  EXPECT_NEAR(samples.columns[0].interval.high, apart.high, 1e-9);
}

TEST(CompareRuns, LeavesOutFaultsAndWhatOnlyOneRunHas) {
  TwoRuns runs(10, 0, 0, 0);
  runs.a[3] = {3, TrialOutcome::kSimulatorFault, "", {}};
  runs.b.resize(8);
  EXPECT_EQ(runs.Compare().pairs, 7);
}

// Those that both drove to the end differ by 0.5 m; one that only one of both did, by much more.
TEST(CompareRuns, DistancesOfArrivedPairsBesideThoseOfAll) {
  TwoRuns runs(30, 8, 1, 11);
  for (std::size_t i = 30; i < runs.b.size(); ++i) runs.b[i].values[1] += 4.0;
  const RunComparison paired = runs.Compare();
  ASSERT_EQ(paired.arrived_columns.size(), 1U);
  EXPECT_EQ(paired.arrived_columns[0].count, 30);
  EXPECT_NEAR(paired.arrived_columns[0].difference, 0.5, 1e-12);
  EXPECT_EQ(paired.columns[0].count, 50);
  EXPECT_NEAR(paired.columns[0].difference, 0.5 + 4.0 * 20.0 / 50.0, 1e-12);
  // As two samples each run has its own: 38 of the first arrived, 31 of the second.
  const RunComparison samples = runs.Compare(2);
  EXPECT_EQ(samples.arrived_columns[0].count, 38);
  EXPECT_EQ(samples.arrived_columns[0].second_count, 31);
  double first_m = 0.0;
  for (int i = 0; i < 38; ++i) first_m += runs.a[static_cast<std::size_t>(i)].values[0] / 38.0;
  EXPECT_NEAR(samples.arrived_columns[0].first_mean, first_m, 1e-12);
}

TEST(CompareRuns, NoPairArrived) {
  const RunComparison result = TwoRuns(0, 5, 5, 5).Compare();
  EXPECT_EQ(result.arrived_columns[0].count, 0);
  const auto text = [&](bool every_column) {
    return RunComparisonText(TwoRuns(0, 5, 5, 5).First(), TwoRuns(0, 5, 5, 5).Second(), result, "",
                             every_column);
  };
  EXPECT_THAT(text(true), HasSubstr("means, both arrived"));
  EXPECT_THAT(text(false), Not(HasSubstr("means, both arrived")));
  const TwoRuns some(5, 0, 0, 0);
  EXPECT_THAT(RunComparisonText(some.First(), some.Second(), some.Compare()),
              HasSubstr("means, both arrived"));
}

TEST(CompareRuns, OtherFieldsAreNotCalledEqualRocks) {
  const TwoRuns runs(30, 8, 1, 11);
  ComparedRun other = runs.Second();
  other.fields = "more rocks";
  EXPECT_THAT(RunComparisonText(runs.First(), other, CompareRuns(runs.First(), other)),
              HasSubstr("other settings of terrain"));
}

TEST(CompareRuns, AllowsForTrialsThatShareTheirRocks) {
  const truth::RecordSchema schema{{"layout", "1", ""}};
  std::vector<Record> own;
  std::vector<Record> shared;
  for (std::uint64_t i = 0; i < 6; ++i) {
    own.push_back({i, TrialOutcome::kGoalReached, "", {static_cast<double>(i)}});
    shared.push_back({i, TrialOutcome::kGoalReached, "", {static_cast<double>(i / 3)}});
  }
  const ComparedRun each{"each", 1, schema, own};
  const ComparedRun three{"three", 1, schema, shared};
  EXPECT_FALSE(CompareRuns(each, each).shared_layouts);
  const RunComparison result = CompareRuns(each, three);
  EXPECT_TRUE(result.shared_layouts);
  EXPECT_THAT(RunComparisonText(each, three, result),
              AllOf(HasSubstr("intervals allow for it"), Not(HasSubstr("p = "))));
  // Two groups of three that agree say as much as two trials, with Student's of one degree.
  EXPECT_GT(result.successes[0].interval.high, 0.9);
  EXPECT_LT(CompareRuns(each, each).successes[0].interval.high, 0.5);
}

// Layouts of three in one run and of two in the other chain six trials together; a fault in the
// middle of a layout does not divide it.
TEST(CompareRuns, ALayoutStaysWholeAroundAFault) {
  const TwoRuns runs(30, 8, 1, 9);
  ComparedRun first = runs.First();
  ComparedRun second = runs.Second();
  for (std::size_t i = 0; i < first.records.size(); ++i) {
    first.groups.push_back(i / 3);
    second.groups.push_back(i / 2);
  }
  const auto width = [](const ComparedRun& a, const ComparedRun& b) {
    const statistics::Interval interval = CompareRuns(a, b).successes[0].interval;
    return interval.high - interval.low;
  };
  ComparedRun six = first;
  for (std::size_t i = 0; i < six.groups.size(); ++i) six.groups[i] = i / 6;
  EXPECT_EQ(width(first, second), width(six, runs.Second()));
  EXPECT_NE(width(first, runs.Second()), width(six, runs.Second()));
  std::vector<Record> faulted(first.records.begin(), first.records.end());
  faulted[1].outcome = TrialOutcome::kSimulatorFault;
  first.records = faulted;
  ComparedRun whole = first;
  whole.groups[1] = 99;  // what a fault leaves tells no layout
  EXPECT_EQ(width(first, runs.Second()), width(whole, runs.Second()));
}

// As two samples, each side by its own layouts; what the records do not tell is told beside them.
TEST(CompareRuns, SamplesAreOfTheLayoutsThatTheyHave) {
  const TwoRuns runs(30, 8, 1, 11);
  ComparedRun first = runs.First();
  const RunComparison plain = CompareRuns(first, runs.Second(2));
  for (std::size_t i = 0; i < first.records.size(); ++i) first.groups.push_back(i / 5);
  const RunComparison shared = CompareRuns(first, runs.Second(2));
  EXPECT_TRUE(std::isfinite(plain.successes[0].p_value));
  EXPECT_TRUE(std::isnan(shared.successes[0].p_value));
  EXPECT_EQ(plain.successes[0].difference, shared.successes[0].difference);
  EXPECT_LT(shared.successes[0].interval.low, plain.successes[0].interval.low);
  EXPECT_GT(shared.successes[0].interval.high, plain.successes[0].interval.high);
  EXPECT_EQ(plain.columns[0].difference, shared.columns[0].difference);
}

TEST(RunComparisonCsv, HoldsBothTables) {
  const std::string csv = RunComparisonCsv(TwoRuns(30, 8, 1, 11).Compare());
  EXPECT_THAT(csv, core::Says("\nall,true_distance_m,m,50,", "\narrived,true_distance_m,m,30,"));
}

TEST(RunComparisonText, SaysWhetherItPairedAndFits) {
  const TwoRuns runs(300, 80, 10, 110);
  const std::string paired = RunComparisonText(runs.First(), runs.Second(), runs.Compare());
  EXPECT_THAT(paired, core::Says("500 pairs", "McNemar"));
  std::istringstream lines(paired);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  const std::string two = RunComparisonText(runs.First(), runs.Second(2), runs.Compare(2));
  EXPECT_THAT(two, core::Says("two samples", "Fisher"));
}

}  // namespace
}  // namespace rockyard::report
