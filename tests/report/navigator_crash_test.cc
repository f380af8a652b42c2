// Drives whose navigator ended the process that ran them, which have an outcome and no value, in
// every file that tells of runs.

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "core/json_text.h"
#include "core/says.h"
#include "report/attribution.h"
#include "report/baseline.h"
#include "report/page_data.h"
#include "report/paired_comparison.h"
#include "report/run_files.h"
#include "report/summary_json.h"
#include "report/summary_text.h"
#include "report/sweep_files.h"
#include "report/trial_outcomes.h"
#include "sample_run.h"
#include "sample_sweep.h"
#include "statistics/drive_summary.h"
#include "truth/end_cause.h"

namespace rockyard::report {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using truth::Record;
using truth::TrialOutcome;

constexpr auto kWilson = statistics::IntervalMethod::kWilson;

Record Crash(std::uint64_t trial, std::size_t columns) {
  const auto sentence = truth::Info(truth::EndCause::kNavigatorCrashed).sentence;
  return truth::MakeNavigatorCrash(trial, std::string(sentence) + ": signal 11", columns);
}

// The sample run with two more trials.
std::vector<Record> CrashedRun() {
  std::vector<Record> records = SampleRecords();
  for (const std::uint64_t trial : {6u, 7u}) {
    records.push_back(Crash(trial, SampleSchema().size()));
  }
  return records;
}

TEST(CrashedDrives, HaveARowWithoutValues) {
  const std::vector<std::string> rows = Lines(WrittenBy(TrialsCsv, SampleSchema(), CrashedRun()));
  ASSERT_EQ(rows.size(), 9u);
  EXPECT_THAT(rows[7], testing::StartsWith("6,navigator_fault,,,,,,,,,navigator_crashed,"));
}

TEST(CrashedDrives, AreAnOutcomeWithItsCause) {
  const auto summary = statistics::Summarize(SampleSchema(), CrashedRun());
  const json told = json::parse(SummaryJson(SampleDescription(), summary));
  EXPECT_EQ(told["outcomes"]["navigator_fault"], 2);
  EXPECT_EQ(told["causes"]["navigator_crashed"], 2);
  EXPECT_EQ(told["declared_success"]["trials"], 7);
  EXPECT_EQ(told["distance_m"]["count"], 5);
  EXPECT_EQ(told["metrics"]["navigator_fault"]["mean"], 2.0 / 7.0);
  EXPECT_TRUE(told["metrics_by_outcome"]["navigator_fault"].empty());
  EXPECT_EQ(told["trials"]["faults"], 1) << "that of the simulator";
  EXPECT_THAT(SummaryText(SampleDescription(), summary),
              core::Says("navigator_fault", "navigator crashed"));
}

// Distances as in the run without them, but arrivals are shares of all.
TEST(CrashedDrives, HaveNoDistance) {
  const auto with = DistanceSteps(SampleSchema(), CrashedRun());
  const auto without = DistanceSteps(SampleSchema(), SampleRecords());
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_EQ(with[i].all.value, without[i].all.value);
    EXPECT_EQ(with[i].all.fraction, without[i].all.fraction);
    EXPECT_EQ(with[i].at_risk, without[i].at_risk);
    EXPECT_DOUBLE_EQ(with[i].goal.event, without[i].goal.event * 5.0 / 7.0);
    EXPECT_DOUBLE_EQ(with[i].limit, without[i].limit * 5.0 / 7.0);
  }
  EXPECT_EQ(with.back().goal.event,
            statistics::Summarize(SampleSchema(), CrashedRun()).declared_success.rate);
  EXPECT_DOUBLE_EQ(with.back().goal.event + with.back().goal.competing, 5.0 / 7.0);
  EXPECT_DOUBLE_EQ(without.back().goal.event + without.back().goal.competing, 1.0);
  EXPECT_THAT(WrittenBy(DistanceCdfCsv, SampleSchema(), CrashedRun()),
              AllOf(Not(testing::ContainsRegex("[ ,:(]nan")), Not(HasSubstr("inf"))));
}

TEST(CrashedDrives, AloneAreNoProblem) {
  const std::vector<Record> alone{Crash(0, 8), Crash(1, 8)};
  EXPECT_THAT(DistanceSteps(SampleSchema(), alone), IsEmpty());
  const auto summary = statistics::Summarize(SampleSchema(), alone);
  EXPECT_EQ(summary.declared_success.trials, 2);
  EXPECT_EQ(summary.declared_success.rate, 0.0);
  EXPECT_THAT(SummaryText(SampleDescription(), summary), HasSubstr("0 of 2"));
  EXPECT_THAT(SummaryJson(SampleDescription(), summary), Not(testing::ContainsRegex("[ ,:(]nan")));
}

// Whoever shows a trial drives it again.
TEST(CrashedDrives, AreNotDrivenAgain) {
  const std::vector<Record> records = CrashedRun();
  EXPECT_THAT(FailedTrials(records), ElementsAre(1, 2, 4));
  EXPECT_EQ(WorstTrials(SampleSchema(), records, 9).size(), 3u);
  EXPECT_THAT(ExampleTrials(SampleSchema(), records), ElementsAre(0, 1, 2, 4));
  // The control: a navigator that reported an error can be watched.
  std::vector<Record> reported = records;
  reported[6].values[0] = 2.0;
  EXPECT_THAT(FailedTrials(reported), ElementsAre(1, 2, 4, 6));
  EXPECT_THAT(ExampleTrials(SampleSchema(), reported), testing::Contains(6));
}

// In cells 0 and 4 of the sweep the first 10 of 40 trials, which arrive elsewhere.
SweepSummary CrashedSweep(const scenario::Sweep& sweep, bool crashed = true) {
  return SummarizeSweep(
      sweep,
      [&](std::size_t cell) {
        SweepCellTrials trials = Trials(10, 9.0);
        if (cell % 4 != 0) return trials;
        for (std::uint64_t i = 0; i < 10; ++i) {
          trials.prefix[i] = crashed ? Crash(i, trials.schema.size())
                                     : Record{i, TrialOutcome::kJammed, "", {9.0, 8.0}};
        }
        return trials;
      },
      kWilson);
}

TEST(CrashedDrives, AreFailuresOfASweep) {
  const scenario::Sweep sweep = TestSweep();
  const SweepSummary summary = CrashedSweep(sweep);
  const SweepSummary jammed = CrashedSweep(sweep, false);
  const SweepCellSummary& cell = summary.cells[0];
  EXPECT_EQ(cell.faults, 1);
  EXPECT_EQ(cell.outcomes[static_cast<std::size_t>(TrialOutcome::kNavigatorFault)], 10);
  EXPECT_EQ(cell.declared_success.rate.trials, 39);
  EXPECT_EQ(cell.declared_success.rate.count, 10);
  // All that is about success is as if they had jammed: rates, fits, differences.
  for (std::size_t i = 0; i < summary.cells.size(); ++i) {
    EXPECT_EQ(summary.cells[i].true_success.rate.count, jammed.cells[i].true_success.rate.count);
    EXPECT_EQ(summary.cells[i].true_success.simultaneous.low,
              jammed.cells[i].true_success.simultaneous.low);
  }
  EXPECT_EQ(SweepFitsCsv(summary), SweepFitsCsv(jammed));
  EXPECT_EQ(SweepDifferencesCsv(summary), SweepDifferencesCsv(jammed));
  // What is about values is not.
  EXPECT_NE(SweepCurvesCsv(sweep, summary), SweepCurvesCsv(sweep, jammed));
  EXPECT_THAT(Lines(SweepCellsCsv(sweep, summary))[0], HasSubstr(",navigator_fault,"));
  for (const std::string& text :
       {SweepCellsCsv(sweep, summary), SweepCurvesCsv(sweep, summary),
        SweepJson(sweep, summary, {}), SweepText(sweep, summary, {}, TextStyle::kPlain)}) {
    EXPECT_THAT(text, Not(testing::ContainsRegex("[ ,:(]nan")));
  }
}

TEST(CrashedDrives, AreAttributedAsFailures) {
  const scenario::Sweep sweep = scenario::ParseSweep(
      R"({"name": "factorial", "trials": 40, "common_random_numbers": true,
          "axes": [{"ablation": "perfect_localization"}]})");
  const auto attribution = [&](const Record& first) {
    std::vector<Record> flown = Trials(10, 9.0).prefix;
    flown[0] = first;
    const std::vector<CellOutcomes> outcomes{CellOutcomes(flown),
                                             CellOutcomes(Trials(15, 9.0).prefix)};
    return AttributionCsv(AttributeSweep(sweep, outcomes));
  };
  const std::string crashed = attribution(Crash(0, 2));
  ASSERT_THAT(crashed, HasSubstr("failure_rate"));
  EXPECT_EQ(crashed, attribution({0, TrialOutcome::kJammed, "", {9.0, 8.0}}));
  EXPECT_NE(crashed, attribution(truth::MakeFault(1, 0, "made up"))) << "the control";
}

TEST(CrashedDrives, ArePairsWithoutValues) {
  const std::vector<Record> first = SampleRecords();
  std::vector<Record> second = first;
  second[0] = Crash(0, SampleSchema().size());
  const ComparedRun a{"a", 1, SampleSchema(), first, "rocks"};
  const ComparedRun b{"b", 1, SampleSchema(), second, "rocks"};
  const RunComparison result = CompareRuns(a, b);
  EXPECT_EQ(result.pairs, 5);
  EXPECT_EQ(result.successes[0].counts.only_first, 1);
  EXPECT_EQ(result.columns[0].count, 4);
  EXPECT_EQ(result.columns[0].difference, 0.0);
  EXPECT_EQ(result.arrived_columns[0].count, 2);
  const ComparedRun other{"b", 2, SampleSchema(), second, "rocks"};
  const RunComparison samples = CompareRuns(a, other);
  EXPECT_EQ(samples.successes[0].second.trials, 5);
  EXPECT_EQ(samples.columns[0].second_count, 4);
  EXPECT_THAT(RunComparisonCsv(result), Not(testing::ContainsRegex("[ ,:(]nan")));
  second[0] = truth::MakeFault(1, 0, "blew up");
  EXPECT_EQ(CompareRuns(a, {"b", 1, SampleSchema(), second, "rocks"}).pairs, 4) << "the control";
}

TEST(CrashedDrives, AreKeptByABaseline) {
  BaselineCell cell;
  cell.resolved = "{}";
  FillBaselineCell(SampleSchema(), CrashedRun(), cell);
  const Baseline baseline{.name = "n", .reason = "r", .build = "b", .cells = {cell}};
  const Baseline read = ParseBaseline(core::ParseJson(BaselineJson(baseline), "baseline"));
  EXPECT_EQ(read.cells[0].outcomes, cell.outcomes);
  EXPECT_EQ(read.cells[0].outcomes[6], TrialOutcome::kNavigatorFault);
  for (const statistics::BaselineMetric& metric : read.cells[0].metrics) {
    const bool rate = metric.name == "declared_success" || metric.name == "navigator_fault";
    if (rate) {
      EXPECT_EQ(metric.values[6], metric.name == "navigator_fault" ? 1.0 : 0.0);
    }
    if (metric.name == "true_distance_m") {
      EXPECT_TRUE(std::isnan(metric.values[6]));
    }
  }
}

TEST(CrashedDrives, StandOnThePage) {
  const std::vector<Record> records = CrashedRun();
  const PageRun page{.label = "sample",
                     .folder = "runs/sample",
                     .cell = "",
                     .sweep = {},
                     .description = SampleDescription(),
                     .schema = SampleSchema(),
                     .records = records,
                     .prefix = records,
                     .parameters = {},
                     .replay_command = "rockyard replay"};
  const json run = json::parse(PageRunMembers(page, kWilson).Text());
  EXPECT_EQ(run["trials"]["columns"][0]["values"][6], nullptr);
  EXPECT_EQ(run["summary"]["outcomes"]["navigator_fault"], 2);
  EXPECT_THAT(run["trials"]["outcome_names"], testing::Contains("navigator_fault"));
  EXPECT_EQ(run["cdf"]["at_risk"][0], 5);
  const auto ending = std::ranges::find_if(
      run["endings"], [](const json& each) { return each["outcome"] == "navigator_fault"; });
  ASSERT_NE(ending, run["endings"].end());
  EXPECT_EQ((*ending)["count"], 2);
  EXPECT_EQ((*ending)["limit"], false);
}

}  // namespace
}  // namespace rockyard::report
