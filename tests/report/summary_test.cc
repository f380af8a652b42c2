#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/says.h"
#include "report/summary_json.h"
#include "report/summary_text.h"
#include "report/trial_outcomes.h"
#include "sample_run.h"
#include "statistics/drive_summary.h"
#include "statistics/metrics.h"
#include "truth/end_cause.h"

namespace rockyard::report {
namespace {

using nlohmann::json;
using statistics::IntervalMethod;
using testing::HasSubstr;
using testing::Not;

statistics::DriveSummary SampleSummary(IntervalMethod method = IntervalMethod::kWilson) {
  return statistics::Summarize(SampleSchema(), SampleRecords(), 8, method);
}

TEST(SummaryJson, HasEveryMemberOfTheLayout) {
  const json summary = json::parse(SummaryJson(SampleDescription(), SampleSummary()));
  EXPECT_EQ(summary["schema_version"], 2);
  EXPECT_EQ(summary["scenario"], "sample");
  EXPECT_EQ(summary["seed"], 9000000000000000001ULL);
  EXPECT_EQ(summary["trials"],
            json({{"planned", 8}, {"stored", 7}, {"completed", 6}, {"faults", 1}}));
  EXPECT_EQ(summary["trial_hash"], "0123456789abcdef");
  for (const char* key : {"version", "commit", "compiler", "flags", "host", "threads", "ranks"}) {
    EXPECT_TRUE(summary["provenance"].contains(key)) << key;
  }
  // Every way in which a drive ends: all but "measured".
  EXPECT_EQ(summary["outcomes"].size(), truth::kTrialOutcomeNames.size() - 1);
  EXPECT_FALSE(summary["outcomes"].contains("measured"));
  EXPECT_EQ(summary["outcomes"]["goal_reached"], 2);
  EXPECT_EQ(summary["outcomes"]["simulator_fault"], 1);
  EXPECT_EQ(summary["outcomes"]["tip_over"], 0);
}

TEST(SummaryJson, RatesLeaveFaultsOut) {
  const json summary = json::parse(SummaryJson(SampleDescription(), SampleSummary()));
  EXPECT_EQ(summary["declared_success"]["count"], 3);
  EXPECT_EQ(summary["declared_success"]["trials"], 5);
  EXPECT_DOUBLE_EQ(summary["declared_success"]["rate"], 0.6);
  // Few of either kind: exact, whatever is asked for.
  EXPECT_EQ(summary["declared_success"]["ci_method"], "clopper_pearson");
  EXPECT_NEAR(summary["declared_success"]["ci95"][0].get<double>(), 0.14663, 1e-5);
  EXPECT_NEAR(summary["declared_success"]["ci95"][1].get<double>(), 0.94726, 1e-5);
  EXPECT_EQ(summary["true_success"]["count"], 2);
}

std::vector<truth::Record> Repeated(int times) {
  std::vector<truth::Record> records;
  for (int i = 0; i < times; ++i) {
    const std::vector<truth::Record> sample = SampleRecords();
    records.insert(records.end(), sample.begin(), sample.end());
  }
  return records;
}

json SummaryOf(const std::vector<truth::Record>& records, IntervalMethod method) {
  const auto summary = statistics::Summarize(SampleSchema(), records, 0, method);
  return json::parse(SummaryJson(SampleDescription(), summary));
}

TEST(SummaryJson, RatesSayHowTheirIntervalsAreMade) {
  const json wilson = SummaryOf(Repeated(4), IntervalMethod::kWilson);
  EXPECT_EQ(wilson["declared_success"]["ci_method"], "wilson");
  EXPECT_EQ(wilson["metrics"]["declared_success"]["ci_method"], "wilson");
  // Wilson, 12 of 20, z = 1.95996: (0.6 + z2/40 -+ z sqrt(0.24/20 + z2/1600)) / (1 + z2/20).
  EXPECT_NEAR(wilson["declared_success"]["ci95"][0].get<double>(), 0.38658, 1e-5);
  EXPECT_NEAR(wilson["declared_success"]["ci95"][1].get<double>(), 0.78119, 1e-5);
  EXPECT_EQ(wilson["metrics"]["tip_over"]["ci_method"], "clopper_pearson") << "none of 20";
  const json exact = SummaryOf(Repeated(4), IntervalMethod::kClopperPearson);
  EXPECT_EQ(exact["declared_success"]["ci_method"], "clopper_pearson");
  EXPECT_EQ(exact["metrics"]["declared_success"]["ci_method"], "clopper_pearson");
}

TEST(SummaryJson, MeansHaveAnIntervalOrAReason) {
  const json few =
      SummaryOf(SampleRecords(), IntervalMethod::kWilson)["metrics"]["true_distance_m"];
  EXPECT_EQ(few["ci95"], json({nullptr, nullptr}));
  EXPECT_TRUE(few["ci_method"].is_null());
  EXPECT_EQ(few["ci_reason"], "5 trials, needs 30");
  const json many = SummaryOf(Repeated(8), IntervalMethod::kWilson)["metrics"]["true_distance_m"];
  EXPECT_EQ(many["ci_method"], "skewed_t");
  EXPECT_FALSE(many.contains("ci_reason"));
  EXPECT_LT(many["ci95"][0].get<double>(), many["mean"].get<double>());
  EXPECT_GT(many["ci95"][1].get<double>(), many["mean"].get<double>());
  EXPECT_TRUE(many["median_ci95"][0].is_number());
  EXPECT_EQ(many["share_apart"]["count"], 24);
  EXPECT_TRUE(many["share_apart"]["ci95"][1].is_number());
}

TEST(SummaryJson, ModesHaveARangeThatClaimsNothing) {
  const json many = SummaryOf(Repeated(8), IntervalMethod::kWilson)["distance_m"];
  EXPECT_THAT(many["mode_method"].get<std::string>(), HasSubstr("no coverage claimed"));
  EXPECT_TRUE(many["mode_range"][0].is_number());
}

TEST(SummaryJson, ColumnsByHand) {
  const json summary = json::parse(SummaryJson(SampleDescription(), SampleSummary()));
  EXPECT_EQ(summary["distance_m"]["count"], 5);
  EXPECT_EQ(summary["distance_m"]["min"], 4.0);
  EXPECT_EQ(summary["distance_m"]["median"], 8.0);
  EXPECT_EQ(summary["distance_m"]["mean"], 7.0);
  EXPECT_EQ(summary["distance_m"]["max"], 9.0);
  EXPECT_EQ(summary["path_ratio"]["count"], 3);
  EXPECT_DOUBLE_EQ(summary["path_ratio"]["max"], 9.0 / 7.6);
  EXPECT_EQ(summary["dead_reckoning"]["heading_error_deg"]["count"], 4) << "one is undefined";
  EXPECT_EQ(summary["sim_time_s"]["max"], 500.0);
  EXPECT_EQ(summary["energy_wh"]["min"], 1.0);
  EXPECT_EQ(summary["columns"]["rocks"]["max"], 8.0);
  EXPECT_FALSE(summary["columns"].contains("true_distance_m"));
}

TEST(SummaryJson, NoTrialsAreNullNotZero) {
  const auto none = statistics::Summarize(SampleSchema(), {}, 8);
  const json summary = json::parse(SummaryJson(SampleDescription(), none));
  EXPECT_TRUE(summary["declared_success"]["rate"].is_null());
  EXPECT_TRUE(summary["distance_m"]["mean"].is_null());
  EXPECT_EQ(summary["distance_m"]["count"], 0);
}

TEST(ResolvedScenarioJson, HoldsScenarioAndProvenance) {
  const json resolved = json::parse(ResolvedScenarioJson(SampleDescription()));
  EXPECT_EQ(resolved["scenario"], json::parse(SampleDescription().resolved));
  EXPECT_EQ(resolved["fingerprint"], "00ff");
  EXPECT_EQ(resolved["provenance"]["builds"][0], "0.1.0 abc");
}

TEST(SummaryText, FitsAndColoursOnRequestOnly) {
  RunDescription run = SampleDescription();
  run.scenario = std::string(300, 'n');
  const std::string text = SummaryText(run, SampleSummary());
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  EXPECT_THAT(text, core::Says("3 of 5", "14.7 .. 94.7 %", "1 simulator faults",
                               "1 more finished trials", "0123456789abcdef"));
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_NE(SummaryText(run, SampleSummary(), TextStyle::kColour).find('\x1b'), std::string::npos);
}

statistics::MetricSummary Summary(std::string_view metric, const std::vector<double>& values) {
  return statistics::SummarizeMetric(*statistics::FindMetric(metric), values);
}

std::string TextOf(const statistics::MetricSummary& metric) {
  statistics::DriveSummary summary = SampleSummary();
  summary.metrics = {metric};
  return SummaryText(SampleDescription(), summary);
}

// Three ways of finding no way on, and a jam; of the other drives the outcome says it all.
std::vector<truth::Record> WithCauses() {
  using truth::EndCause;
  std::vector<truth::Record> records;
  for (const EndCause cause :
       {EndCause::kPatienceDistance, EndCause::kGaveUp, EndCause::kPatienceDistance,
        EndCause::kNoticedStuck, EndCause::kNoMotion, EndCause::kArrived}) {
    records.push_back({.trial = records.size(),
                       .outcome = truth::Info(cause).outcome,
                       .detail = std::string(truth::Info(cause).sentence),
                       .values = SampleRecords()[0].values});
  }
  return records;
}

TEST(SummaryJson, CountsCausesAndHasTheirRates) {
  const json summary = SummaryOf(WithCauses(), IntervalMethod::kWilson);
  EXPECT_EQ(summary["causes"], json({{"patience_distance", 2},
                                     {"gave_up", 1},
                                     {"noticed_stuck", 1},
                                     {"no_motion", 1},
                                     {"arrived", 1}}));
  EXPECT_EQ(summary["outcomes"]["no_path"], 4);
  EXPECT_EQ(summary["ended_by_limit"]["count"], 2);
  EXPECT_EQ(summary["ended_by_limit"]["trials"], 6);
  EXPECT_EQ(summary["declared_success_without_limits"], json({1.0 / 6.0, 3.0 / 6.0}));
  const auto rate = [&](const char* name) {
    return summary["metrics"].at(name)["mean"].get<double>();
  };
  EXPECT_DOUBLE_EQ(rate("no_path"), 4.0 / 6.0);
  EXPECT_DOUBLE_EQ(rate("patience_distance"), 2.0 / 6.0);
  EXPECT_DOUBLE_EQ(rate("gave_up"), 2.0 / 6.0);  // noticing that it is stuck is giving up
  EXPECT_EQ(rate("patience_turning"), 0.0);
  EXPECT_FALSE(summary["metrics_by_outcome"]["no_path"].contains("patience_distance"));
}

// Arrivals need no line of their own, unless some found a rock instead.
TEST(SummaryText, TellsHowGoalsWereReachedWhereItIsNotPlain) {
  using truth::EndCause;
  const auto text = [](EndCause second) {
    std::vector<truth::Record> records;
    for (const EndCause cause : {EndCause::kArrived, second}) {
      records.push_back({.trial = records.size(),
                         .outcome = truth::Info(cause).outcome,
                         .detail = std::string(truth::Info(cause).sentence),
                         .values = WithCauses().front().values});
    }
    return SummaryText(SampleDescription(), statistics::Summarize(SampleSchema(), records));
  };
  EXPECT_EQ(text(EndCause::kArrived).find("course.goal_radius_m"), std::string::npos);
  EXPECT_NE(text(EndCause::kFoundRock).find("found the rock"), std::string::npos);
  EXPECT_NE(text(EndCause::kFoundRock).find("course.goal_radius_m"), std::string::npos);
}

TEST(SummaryText, TellsCausesBelowOutcomesThatHaveSeveral) {
  const std::string text =
      SummaryText(SampleDescription(), statistics::Summarize(SampleSchema(), WithCauses()));
  EXPECT_THAT(text, HasSubstr("  no_path                 4             66.7 %"));
  EXPECT_THAT(text, HasSubstr("  ended by a limit        2 of 6        33.3 %   95 % interval"));
  EXPECT_THAT(
      text, HasSubstr("without patience and time limit 16.7 .. 50.0 % of these declare success\n"));
  EXPECT_THAT(
      text,
      HasSubstr("    patience: distance         2       33.3 %   referee.no_path_distance_m\n"));
  EXPECT_THAT(text, HasSubstr("    navigator gave up          1       16.7 %\n"));
  EXPECT_THAT(text, Not(HasSubstr("patience: turning")));
  EXPECT_THAT(text, Not(HasSubstr("    arrived")));
}

TEST(SummaryText, WithoutAnEventThereIsAShareAndNoIntervalOfTheMean) {
  std::vector<double> scrapes(40, 0.0);
  const std::string none = TextOf(Summary("scrapes", scrapes));
  EXPECT_THAT(none,
              core::Says("scrapes                       0.00                      -      0.00",
                         "no interval of the mean: all are 0\n"));
  // 1 - 0.025^(1/40).
  EXPECT_THAT(none, HasSubstr("0 of 40 trials differ from 0, 0.0 .. 8.8 % (exact)"));
  scrapes[7] = 3.0;
  EXPECT_THAT(TextOf(Summary("scrapes", scrapes)),
              HasSubstr("no interval of the mean: 1 trials differ from 0, needs 10"));
  for (std::size_t i = 0; i < 30; ++i) scrapes[i] = static_cast<double>(i % 7 + 1);
  const std::string many = TextOf(Summary("scrapes", scrapes));
  EXPECT_EQ(many.find("no interval"), std::string::npos);
  EXPECT_EQ(many.find("differ from"), std::string::npos) << "they are no exception";
  EXPECT_THAT(many, HasSubstr("median"));
}

TEST(SummaryText, SaysThatModesAreUnsteady) {
  EXPECT_THAT(SummaryText(SampleDescription(), SampleSummary()),
              HasSubstr("* half-sample mode: unsteady, no coverage claimed"));
}

// Numbers as large as any run's, and a name that could break the line or the terminal.
TEST(SummaryText, FitsWhateverTheNumbersAre) {
  constexpr std::int64_t kMax = 1'000'000'000;
  RunDescription run = SampleDescription();
  run.scenario = "odd\n\x1b[31m name with " + std::string(300, 'n');
  run.localization = "oracle";
  run.planned = kMax;
  run.stored = kMax;
  run.ablations = {std::string(90, 'a'), std::string(90, 'b')};
  run.accounting = {kMax, kMax, kMax, kMax, kMax};
  run.stopping = LargestStopping();
  statistics::DriveSummary summary = SampleSummary();
  summary.completed = kMax;
  summary.faults = kMax;
  summary.declared_success = {kMax, kMax, 1.0, {1.0, 1.0}};
  summary.outcomes.fill(kMax);
  for (statistics::ColumnSummary& column : summary.columns) {
    column.mean = column.max = column.p95 = -1.2345e300;
    column.min = -0.0001;
  }
  const std::string text = SummaryText(run, summary);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  EXPECT_THAT(text, testing::StartsWith("odd ?[31m name with nnn"));
  EXPECT_THAT(text, testing::Not(HasSubstr("-0.00")));
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

TEST(SummaryText, FlagsPerfectLocalization) {
  RunDescription run = SampleDescription();
  EXPECT_EQ(SummaryText(run, SampleSummary()).find("perfect"), std::string::npos);
  run.localization = "oracle";
  EXPECT_THAT(SummaryText(run, SampleSummary()), HasSubstr("perfect localization"));
}

using testing::ElementsAre;
using testing::IsEmpty;
using truth::TrialOutcome;

const truth::RecordSchema kSchema{{"scans", "1", ""}, {"true_goal_distance_m", "m", ""}};

std::vector<truth::Record> Records() {
  return {{0, TrialOutcome::kGoalReached, "", {1.0, 0.1}},
          {1, TrialOutcome::kFalseGoal, "", {1.0, 0.8}},
          {2, TrialOutcome::kJammed, "", {1.0, 5.0}},
          {3, TrialOutcome::kNoPath, "", {1.0, 6.0}},
          {4, TrialOutcome::kSimulatorFault, "", {}},
          {5, TrialOutcome::kTipOver, "", {1.0, 5.0}}};
}

TEST(WorstTrials, FurthestFromTheGoalFirstThenByNumber) {
  EXPECT_THAT(WorstTrials(kSchema, Records(), 10), ElementsAre(3, 2, 5, 1));
  EXPECT_THAT(WorstTrials(kSchema, Records(), 2), ElementsAre(3, 2));
  EXPECT_THAT(WorstTrials(kSchema, Records(), 0), IsEmpty());
}

TEST(WorstTrials, NeitherSuccessNorFaultIsAFailure) {
  EXPECT_THAT(FailedTrials(Records()), ElementsAre(1, 2, 3, 5));
}

// NaN in a comparison is no order: the sort would be undefined, and would place them anywhere.
TEST(WorstTrials, WhatIsUnknownComesFirst) {
  std::vector<truth::Record> records;
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    const auto number = static_cast<double>(trial);
    const double distance_m = trial % 3 == 0 ? std::nan("") : number;
    records.push_back({trial, TrialOutcome::kJammed, "", {1.0, distance_m}});
  }
  records[9].values[1] = std::numeric_limits<double>::infinity();
  records[10].values.clear();
  const std::vector<std::uint64_t> worst = WorstTrials(kSchema, records, 200);
  ASSERT_EQ(worst.size(), 200u);
  EXPECT_THAT(std::vector(worst.begin(), worst.begin() + 5), ElementsAre(0, 3, 6, 9, 10));
  EXPECT_THAT(std::vector(worst.begin() + 68, worst.begin() + 71), ElementsAre(199, 197, 196));
}

TEST(WorstTrials, ByNumberWithoutADistance) {
  const truth::RecordSchema other{{"scans", "1", ""}};
  EXPECT_THAT(WorstTrials(other, Records(), 2), ElementsAre(1, 2));
}

const truth::RecordSchema kDistances{{"true_distance_m", "m", ""}};

TEST(ExampleTrials, TheMedianOfEachOutcomeTheCommonestFirst) {
  const std::vector<truth::Record> records{
      {0, TrialOutcome::kGoalReached, "", {9.0}}, {1, TrialOutcome::kNoPath, "", {3.0}},
      {2, TrialOutcome::kNoPath, "", {1.0}},      {3, TrialOutcome::kNoPath, "", {2.0}},
      {4, TrialOutcome::kSimulatorFault, "", {}}, {5, TrialOutcome::kMeasured, "", {1.0}}};
  EXPECT_THAT(ExampleTrials(kDistances, records), ElementsAre(3, 0));
}

TEST(ExampleTrials, OfTwoTheLowerAndOfEqualsTheFirst) {
  EXPECT_THAT(
      ExampleTrials(kDistances, std::vector<truth::Record>{{7, TrialOutcome::kJammed, "", {5.0}},
                                                           {8, TrialOutcome::kJammed, "", {4.0}}}),
      ElementsAre(8));
  // Of the six trials, 0 and 5 reached the goal after 8 m each.
  EXPECT_THAT(ExampleTrials(SampleSchema(), SampleRecords()), ElementsAre(0, 1, 2, 4));
}

TEST(ExampleTrials, WithoutDistancesByNumber) {
  const truth::RecordSchema other{{"scans", "1", ""}};
  EXPECT_THAT(
      ExampleTrials(other, std::vector<truth::Record>{{2, TrialOutcome::kJammed, "", {1.0}},
                                                      {0, TrialOutcome::kJammed, "", {3.0}},
                                                      {1, TrialOutcome::kJammed, "", {2.0}}}),
      ElementsAre(1));
  EXPECT_THAT(ExampleTrials(kDistances, {}), IsEmpty());
}

}  // namespace
}  // namespace rockyard::report
