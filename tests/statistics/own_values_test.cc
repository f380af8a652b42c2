// What navigators count for themselves, as metrics.

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/random.h"
#include "statistics/metrics.h"
#include "statistics/regression.h"
#include "truth/drive_record.h"

namespace rockyard::statistics {
namespace {

using testing::ElementsAre;
using truth::Record;
using truth::TrialOutcome;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

truth::RecordSchema Schema() {
  return {{"true_distance_m", "m", "path"},
          {"mine.replans", "1", "plans made anew"},
          {"mine.waited_s", "s", "time at rest"},
          {"other.looks", "1", "looks"}};
}

// "other" drives none of them; the navigator of trial 2 failed before it counted.
std::vector<Record> Records() {
  return {{0, TrialOutcome::kGoalReached, "", {8.0, 3.0, 1.5, kNaN}},
          {1, TrialOutcome::kJammed, "", {2.0, 5.0, 0.5, kNaN}},
          {2, TrialOutcome::kNavigatorFault, "", {1.0, kNaN, kNaN, kNaN}},
          {3, TrialOutcome::kSimulatorFault, "", {}}};
}

const MetricSummary* Find(const std::vector<MetricSummary>& all, std::string_view name) {
  const auto found = std::ranges::find_if(
      all, [&](const MetricSummary& each) { return each.metric.name == name; });
  return found == all.end() ? nullptr : &*found;
}

TEST(OwnMetrics, FollowTheBuiltInOnesWithTheirColumnsTexts) {
  const std::vector<Metric> metrics = MetricsOf(Schema());
  ASSERT_EQ(metrics.size(), Metrics().size() + 3);
  for (std::size_t i = 0; i < Metrics().size(); ++i) EXPECT_EQ(metrics[i].name, Metrics()[i].name);
  const Metric& first = metrics[Metrics().size()];
  EXPECT_EQ(first.name, "mine.replans");
  EXPECT_EQ(first.unit, "1");
  EXPECT_EQ(first.definition, "plans made anew");
  EXPECT_EQ(first.kind, MetricKind::kMean);
  EXPECT_EQ(first.trials, MetricTrials::kAll);
  EXPECT_EQ(first.source, MetricSource::kColumn);
  EXPECT_EQ(first.columns[0], "mine.replans");
  EXPECT_EQ(metrics.back().name, "other.looks");
  EXPECT_GT(DefaultMargin(first, 0.0), 0.0);
}

// The control: without such a column nothing is added, and no built-in column is taken for one.
TEST(OwnMetrics, AreNoneWhereNoNavigatorCounts) {
  EXPECT_EQ(MetricsOf({{"true_distance_m", "m", ""}}).size(), Metrics().size());
  for (const truth::DriveColumn& column : truth::kDriveColumns) {
    EXPECT_FALSE(truth::IsOwnColumn(column.name)) << column.name;
  }
  for (const Metric& metric : Metrics()) EXPECT_FALSE(truth::IsOwnColumn(metric.name));
  EXPECT_TRUE(truth::IsOwnColumn(truth::OwnColumn("mine", "replans")));
}

TEST(OwnMetrics, AreFoundByNameWithTheTextsThatAreKnown) {
  EXPECT_EQ(FindMetric("mine.waited_s", Schema())->unit, "s");
  EXPECT_EQ(FindMetric("mine.waited_s")->unit, "") << "no schema tells it";
  EXPECT_EQ(FindMetric("mine.waited_s")->columns[0], "mine.waited_s");
  EXPECT_EQ(FindMetric("scans", Schema())->definition, "hazard scans");
  EXPECT_FALSE(FindMetric("replans", Schema()));
}

// By hand: 3 and 5 have a mean of 4.
TEST(OwnMetrics, AreMeansOfTheTrialsThatHaveValues) {
  const std::vector<MetricSummary> all = SummarizeMetrics(Schema(), Records());
  const MetricSummary* replans = Find(all, "mine.replans");
  ASSERT_NE(replans, nullptr);
  EXPECT_EQ(replans->count, 2);
  EXPECT_DOUBLE_EQ(replans->mean, 4.0);
  EXPECT_EQ(replans->min, 3.0);
  const MetricSummary* looks = Find(all, "other.looks");
  ASSERT_NE(looks, nullptr);
  EXPECT_EQ(looks->count, 0);
  EXPECT_TRUE(std::isnan(looks->mean));
  EXPECT_EQ(Find(all, "navigator_fault")->mean, 1.0 / 3.0);
  const auto jammed =
      SummarizeMetrics(Schema(), Records(), IntervalMethod::kWilson, TrialOutcome::kJammed);
  EXPECT_EQ(Find(jammed, "mine.replans")->mean, 5.0);
}

// A summary keeps the texts of a schema that is gone.
TEST(OwnMetrics, OwnTheirTexts) {
  std::vector<MetricSummary> all;
  {
    truth::RecordSchema schema = Schema();
    schema[1].meaning = std::string(200, 'x');
    all = SummarizeMetrics(schema, Records());
    for (truth::ValueInfo& column : schema) column.name = column.meaning = "overwritten";
  }
  EXPECT_EQ(Find(all, "mine.replans")->metric.definition, std::string(200, 'x'));
}

std::vector<double> Normals(std::uint32_t set, double mean) {
  core::RandomStream stream({.seed = 91, .trial = set}, core::Purpose::kTest);
  std::vector<double> values(100);
  for (double& x : values) x = core::SampleNormal(stream, mean, 1.0);
  return values;
}

RegressionResult Check(std::vector<double> run, truth::RecordSchema schema) {
  const std::vector<BaselineMetric> baseline = {{"declared_success", 0.1, Normals(1, 5.0)},
                                                {"mine.replans", 0.5, Normals(2, 5.0)}};
  const RegressionCell cell{.name = "cell",
                            .paired = true,
                            .baseline = baseline,
                            .run = {Normals(1, 5.0), std::move(run)},
                            .schema = std::move(schema)};
  return CheckRegression(std::span(&cell, 1));
}

TEST(OwnMetrics, AreCheckedAsSecondaryOnes) {
  const RegressionResult moved = Check(Normals(3, 7.0), Schema());
  ASSERT_EQ(moved.rows.size(), 2u);
  EXPECT_EQ(moved.rows[1].metric.name, "mine.replans");
  EXPECT_EQ(moved.rows[1].metric.unit, "1");
  EXPECT_FALSE(moved.rows[1].primary);
  EXPECT_EQ(moved.rows[1].verdict, RegressionVerdict::kChanged);
  EXPECT_EQ(ExitCode(moved), 1);
  const RegressionResult same = Check(Normals(2, 5.0), Schema());
  EXPECT_EQ(same.rows[1].verdict, RegressionVerdict::kEquivalent) << "the control";
  EXPECT_EQ(ExitCode(same), 0);
}

// A run of another version of the navigator, which does not count it: told, and undecided.
TEST(OwnMetrics, ThatARunLacksAreInconclusive) {
  const RegressionResult lacking = Check({}, {{"true_distance_m", "m", ""}});
  ASSERT_EQ(lacking.rows.size(), 2u);
  EXPECT_EQ(lacking.rows[1].metric.name, "mine.replans");
  EXPECT_EQ(lacking.rows[1].run_count, 0);
  EXPECT_EQ(lacking.rows[1].verdict, RegressionVerdict::kInconclusive);
  EXPECT_EQ(ExitCode(lacking), 4);
}

}  // namespace
}  // namespace rockyard::statistics
