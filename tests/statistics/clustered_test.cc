// Rates and means of trials that hang together: which do, and whether their intervals hold.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "core/random.h"
#include "statistics/clustered_rate.h"
#include "statistics/drive_summary.h"

namespace rockyard::statistics {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using truth::TrialOutcome;

// Runs of up to `size` trials. A trial does what its run has drawn with probability `together`
// (within a run two trials then correlate by its square), else draws for itself.
struct Law {
  std::size_t runs;
  std::size_t size;
  double rate;
  double together;
};

std::vector<CountOfRun> Draw(const Law& law, std::uint32_t campaign) {
  core::RandomStream stream({20261129, campaign}, core::Purpose::kTest);
  std::vector<CountOfRun> runs;
  for (std::size_t run = 0; run < law.runs; ++run) {
    const bool drawn = stream.Uniform() < law.rate;
    CountOfRun& counted = runs.emplace_back();
    // One run in three was cut off half way.
    const std::size_t size = run % 3 == 2 ? (law.size + 1) / 2 : law.size;
    for (std::size_t i = 0; i < size; ++i) {
      const bool own = stream.Uniform() < law.rate;
      const bool event = stream.Uniform() < law.together ? drawn : own;
      counted.count += event ? 1.0 : 0.0;
      counted.base += 1.0;
    }
  }
  return runs;
}

constexpr int kCampaigns = 1000;

double Coverage(const Law& law, bool independent) {
  int held = 0;
  for (std::uint32_t campaign = 0; campaign < kCampaigns; ++campaign) {
    const Interval interval = RateOfRuns(Draw(law, campaign), independent).interval;
    if (interval.low <= law.rate && law.rate <= interval.high) ++held;
  }
  return static_cast<double>(held) / kCampaigns;
}

// 0.93, which intervals of 95 % must keep, less four standard errors: below that by chance in one
// of 30,000 such tests.
const double kLeast = 0.93 - 4.0 * std::sqrt(0.93 * 0.07 / kCampaigns);

void ExpectHeld(std::size_t size, const std::vector<std::size_t>& all_runs,
                const std::vector<double>& rates, const std::vector<double>& all_together) {
  for (const std::size_t runs : all_runs) {
    for (const double rate : rates) {
      for (const double together : all_together) {
        const double coverage = Coverage({runs, size, rate, together}, false);
        EXPECT_GT(coverage, kLeast) << runs << " runs, " << rate << ", together " << together;
      }
    }
  }
}

TEST(ClusteredRate, HoldsOnLayoutsOfFive) {
  ExpectHeld(5, {8, 20, 60}, {0.03, 0.2, 0.85}, {0.0, 0.4, 0.73, 0.95});
}

// Design effects of missions were 1.9 to 4.1: correlations within a mission of 0.03 to 0.11.
TEST(ClusteredRate, HoldsForMissionsOfThirtyGoals) {
  ExpectHeld(30, {10, 30}, {0.05, 0.3, 0.9}, {0.0, 0.18, 0.33, 0.55});
}

TEST(ClusteredRate, HoldsForHazardsOfFortyFields) {
  for (const double together : {0.0, 0.18, 0.33, 0.55}) {
    EXPECT_GT(Coverage({40, 50, 0.1, together}, false), kLeast) << "together " << together;
  }
}

// Negative control: what takes them as independent is found out.
TEST(ClusteredRate, IntervalsOfIndependentTrialsDoNotHold) {
  EXPECT_LT(Coverage({60, 5, 0.85, 0.73}, true), 0.85);
  EXPECT_LT(Coverage({30, 30, 0.3, 0.33}, true), 0.75);
  EXPECT_GT(Coverage({60, 5, 0.85, 0.0}, true), kLeast);
}

TEST(ClusteredRate, IsThatOfPlainTrialsWhereEachRunHasOne) {
  const std::vector<CountOfRun> single = {{1, 1}, {0, 1}, {1, 1}, {1, 1}, {0, 0}};
  const Proportion rate = RateOfRuns(single);
  const Proportion plain = MakeProportion(3, 4);
  EXPECT_EQ(rate.method, plain.method);
  EXPECT_EQ(rate.interval.low, plain.interval.low);
  EXPECT_EQ(rate.interval.high, plain.interval.high);
  EXPECT_EQ(RateOfRuns(std::vector<CountOfRun>{{1, 2}, {0, 1}}).method, IntervalMethod::kClustered);
}

// Of 40 layouts of five: events on four cannot show it, events on five can. Of 20, ten events of
// 100 would be two if each layout were one trial.
TEST(ClusteredRate, FewRunsWithEventsCannotShowHowTheyHangTogether) {
  const auto width = [](std::size_t layouts, std::size_t events) {
    std::vector<CountOfRun> runs(layouts, {0, 5});
    for (std::size_t run = 0; run < events; ++run) runs[run].count = 1;
    const Interval interval = ClusteredRateInterval(runs, 0.95);
    return interval.high - interval.low;
  };
  EXPECT_LT(width(40, 5), 0.5 * width(40, 4));
  EXPECT_GT(width(20, 10), 1.5 * width(31, 10));
}

truth::Record On(double layout, TrialOutcome outcome) { return {0, outcome, "", {layout}}; }

TEST(DependentGroups, AreTheLayoutsThatSeveralTrialsShare) {
  const truth::RecordSchema schema{{"layout", "1", ""}};
  const truth::Record fault{0, TrialOutcome::kSimulatorFault, "", {}};
  const std::vector<truth::Record> shared = {On(7, TrialOutcome::kGoalReached),
                                             On(7, TrialOutcome::kJammed), fault,
                                             On(9, TrialOutcome::kGoalReached)};
  EXPECT_THAT(DependentGroups(schema, shared), ElementsAre(0, 0, 1, 2));
  EXPECT_THAT(DependentGroups(schema, std::span(shared).subspan(1)), IsEmpty());
  EXPECT_THAT(DependentGroups({{"other", "1", ""}}, shared), IsEmpty());
}

TEST(DependentGroups, DecideTheRatesOfASummary) {
  const truth::RecordSchema schema{{"layout", "1", ""}};
  std::vector<truth::Record> own;
  std::vector<truth::Record> shared;
  for (int i = 0; i < 100; ++i) {
    const TrialOutcome outcome =
        i / 5 % 2 == 0 ? TrialOutcome::kGoalReached : TrialOutcome::kJammed;
    own.push_back(On(i, outcome));
    shared.push_back(On(i / 5, outcome));
  }
  const DriveSummary plain = Summarize(schema, own);
  const DriveSummary clustered = Summarize(schema, shared);
  EXPECT_FALSE(plain.shared_layouts);
  EXPECT_TRUE(clustered.shared_layouts);
  EXPECT_EQ(plain.true_success.method, IntervalMethod::kWilson);
  EXPECT_EQ(clustered.true_success.method, IntervalMethod::kClustered);
  EXPECT_EQ(plain.true_success.rate, clustered.true_success.rate);
  EXPECT_LT(clustered.true_success.interval.low, plain.true_success.interval.low - 0.1);
  // The metric of that name says the same.
  for (const MetricSummary& metric : clustered.metrics) {
    if (metric.metric.name != "true_success") continue;
    EXPECT_EQ(metric.method, IntervalMethod::kClustered);
    EXPECT_EQ(metric.interval.low, clustered.true_success.interval.low);
  }
}

// Whether the paired interval of runs that share draws, as Law says, holds the difference of the
// rates; with `alone` as if each pair were a run.
double PairedCoverage(const Law& law, double second_rate, bool alone) {
  int held = 0;
  for (std::uint32_t campaign = 0; campaign < kCampaigns; ++campaign) {
    core::RandomStream stream({20261131, campaign}, core::Purpose::kTest);
    // Both ways meet the same draw in six pairs of ten.
    const auto pair = [&] {
      const double first = stream.Uniform();
      const bool same = stream.Uniform() < 0.6;
      const double other = stream.Uniform();
      return ((same ? first : other) < second_rate ? 1.0 : 0.0) - (first < law.rate ? 1.0 : 0.0);
    };
    ClusteredValues differences;
    std::size_t number = 0;
    for (std::size_t run = 0; run < law.runs; ++run) {
      const double drawn = pair();
      for (std::size_t i = 0; i < (run % 3 == 2 ? (law.size + 1) / 2 : law.size); ++i, ++number) {
        const double own = pair();
        differences.Add(alone ? number : run, stream.Uniform() < law.together ? drawn : own);
      }
    }
    const Interval interval = AgrestiMinInterval(differences.Effective(kConfidence), kConfidence);
    const double difference = second_rate - law.rate;
    if (interval.low <= difference && difference <= interval.high) ++held;
  }
  return static_cast<double>(held) / kCampaigns;
}

TEST(ClusteredValues, PairedIntervalsHoldOnLayoutsOfFive) {
  for (const std::size_t runs : {8, 20, 60}) {
    for (const double second : {0.1, 0.25, 0.6}) {
      for (const double together : {0.0, 0.4, 0.73, 0.95}) {
        EXPECT_GT(PairedCoverage({runs, 5, 0.1, together}, second, false), kLeast)
            << runs << " runs, second " << second << ", together " << together;
      }
    }
  }
  EXPECT_LT(PairedCoverage({60, 5, 0.1, 0.73}, 0.6, true), 0.85);  // the negative control
}

// 60 groups of five, some of two: values of a group share half of their variance.
TEST(MeanOfTrials, HoldsWhereValuesHangTogether) {
  int held = 0;
  int as_independent = 0;
  for (std::uint32_t campaign = 0; campaign < kCampaigns; ++campaign) {
    core::RandomStream stream({20261130, campaign}, core::Purpose::kTest);
    std::vector<double> values;
    std::vector<std::size_t> groups;
    for (std::size_t group = 0; group < 60; ++group) {
      const double shared = -std::log1p(-stream.Uniform());
      for (std::size_t i = 0; i < 5; ++i) {
        const double own = -std::log1p(-stream.Uniform());
        const bool counts = group % 4 != 3 || i < 2;
        values.push_back(counts ? shared + own : std::numeric_limits<double>::quiet_NaN());
        groups.push_back(group);
      }
    }
    const auto covers = [](const Interval& interval) {
      return interval.low <= 2.0 && 2.0 <= interval.high;
    };
    if (covers(MeanOfTrials(values, groups).interval)) ++held;
    if (covers(MeanOfTrials(values, {}).interval)) ++as_independent;
  }
  EXPECT_GT(held, kLeast * kCampaigns);
  EXPECT_LT(as_independent, 0.85 * kCampaigns);
}

}  // namespace
}  // namespace rockyard::statistics
