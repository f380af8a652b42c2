// A sweep of made-up trials: what its files say.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "report/csv.h"
#include "report/sweep_files.h"
#include "report/sweep_summary.h"
#include "statistics/confidence_sequence.h"

namespace rockyard::report {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using truth::TrialOutcome;

constexpr std::int64_t kTrials = 40;

// Navigators a and b at four abundances, with common random numbers.
scenario::Sweep TestSweep(std::string_view extra = R"("common_random_numbers": true,)") {
  return scenario::ParseSweep(std::string(R"({"name": "<test>", "trials": 40, )") +
                              std::string(extra) + R"(
    "axes": [{"name": "navigator", "levels": [{"name": "a"},
                                              {"name": "b", "set": {"course.goal_radius_m": 0.7}}]},
             {"path": "terrain.rocks.k_per_m2", "values": [0.002, 0.004, 0.008, 0.016]}]})");
}

// Trials of a cell: that many truly arrive, as many again falsely, one is a fault, the rest are
// stuck.
SweepCellTrials Trials(std::int64_t arrived, double distance_m) {
  SweepCellTrials trials;
  trials.schema = {{"true_distance_m", "m", ""}, {"straight_distance_m", "m", ""}};
  trials.planned = kTrials;
  trials.stored = kTrials;
  for (std::int64_t i = 0; i < kTrials; ++i) {
    truth::Record record{.trial = static_cast<std::uint64_t>(i),
                         .outcome = TrialOutcome::kJammed,
                         .detail = "",
                         .values = {distance_m, 8.0}};
    if (i < 2 * arrived) {
      record.outcome = i % 2 == 0 ? TrialOutcome::kGoalReached : TrialOutcome::kFalseGoal;
    }
    if (i == kTrials - 1) record = truth::MakeFault(1, static_cast<std::uint64_t>(i), "made up");
    trials.prefix.push_back(record);
  }
  trials.trial_hash = std::to_string(arrived) + "/" + std::to_string(distance_m);
  return trials;
}

// Cell i of the sweep: b does better at every abundance but the last.
SweepSummary Summary(const scenario::Sweep& sweep) {
  const std::vector<std::int64_t> arrived{18, 12, 5, 0, 19, 15, 10, 0};
  return SummarizeSweep(
      sweep,
      [&](std::size_t cell) { return Trials(arrived[cell], 10.0 + static_cast<double>(cell)); },
      statistics::IntervalMethod::kWilson);
}

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(SweepSummaryTest, FaultsAreCountedApart) {
  const SweepSummary summary = Summary(TestSweep());
  ASSERT_EQ(summary.cells.size(), 8u);
  const SweepCellSummary& cell = summary.cells[1];
  EXPECT_EQ(cell.completed, kTrials);
  EXPECT_EQ(cell.faults, 1);
  EXPECT_EQ(cell.true_success.rate.count, 12);
  EXPECT_EQ(cell.true_success.rate.trials, kTrials - 1);
  EXPECT_EQ(cell.declared_success.rate.count, 24);
}

TEST(SweepSummaryTest, IntervalsOfAllCellsHoldThoseOfOne) {
  for (const SweepCellSummary& cell : Summary(TestSweep()).cells) {
    for (const SweepRate* rate : {&cell.declared_success, &cell.true_success}) {
      EXPECT_LE(rate->simultaneous.low, rate->rate.interval.low);
      EXPECT_GE(rate->simultaneous.high, rate->rate.interval.high);
    }
  }
}

TEST(SweepSummaryTest, ACurveForEachNavigator) {
  const SweepSummary summary = Summary(TestSweep());
  ASSERT_EQ(summary.curves.size(), 2u);
  EXPECT_EQ(summary.curves[0].label, "navigator=a");
  EXPECT_EQ(summary.curves[1].cells, (std::vector<std::size_t>{4, 5, 6, 7}));
  EXPECT_EQ(summary.curves[1].x, (std::vector<double>{0.002, 0.004, 0.008, 0.016}));
  for (const SweepCurve& curve : summary.curves) {
    for (std::size_t kind = 0; kind < 2; ++kind) {
      ASSERT_EQ(curve.fits[kind].status, statistics::FitStatus::kFitted);
      ASSERT_EQ(curve.crossings[kind].size(), 2u);
      EXPECT_LT(curve.crossings[kind][0].x, curve.crossings[kind][1].x) << "90 % before 50 %";
    }
  }
  EXPECT_LT(summary.curves[0].crossings[0][1].x, summary.curves[1].crossings[0][1].x);
}

TEST(SweepSummaryTest, DifferencesArePairedAndAdjusted) {
  const SweepSummary summary = Summary(TestSweep());
  ASSERT_EQ(summary.differences.size(), 8u) << "four abundances, two kinds of success";
  const SweepDifference& at_middle = summary.differences[4];
  EXPECT_TRUE(at_middle.paired);
  EXPECT_EQ(at_middle.axis, "navigator");
  EXPECT_EQ(at_middle.first, "a");
  EXPECT_EQ(at_middle.second, "b");
  EXPECT_EQ(at_middle.at, "k_per_m2=0.008");
  // 10 declare with a, 20 with b: the ten more are pairs of which only b declares.
  EXPECT_EQ(at_middle.success.counts.only_second, 10);
  EXPECT_EQ(at_middle.success.counts.only_first, 0);
  EXPECT_NEAR(at_middle.success.p_value, 2.0 / 1024.0, 1e-12);
  EXPECT_NEAR(at_middle.adjusted_p, 8.0 * 2.0 / 1024.0, 1e-12) << "the smallest of eight";
}

TEST(SweepSummaryTest, OtherSeedsAreTwoSamples) {
  const SweepSummary summary = Summary(TestSweep(""));
  EXPECT_FALSE(summary.differences[0].paired);
  EXPECT_TRUE(summary.notes.empty());
}

TEST(SweepSummaryTest, EqualCellsAreNamedWhereNumbersAreCommon) {
  const scenario::Sweep sweep = TestSweep();
  const SweepSummary summary = SummarizeSweep(
      sweep, [](std::size_t) { return Trials(3, 9.0); }, statistics::IntervalMethod::kWilson);
  ASSERT_EQ(summary.notes.size(), 7u);
  EXPECT_THAT(summary.notes[0], HasSubstr("had no effect"));
}

TEST(SweepSummaryTest, FitsKnowWhichTrialsHangTogether) {
  for (const SweepCurve& curve : Summary(TestSweep()).curves) {
    for (const statistics::LogisticFit& fit : curve.fits) {
      EXPECT_EQ(fit.clusters, kTrials - 1) << "one fault in each cell, at the same index";
      EXPECT_NE(fit.covariance, fit.model_covariance);
    }
  }
  for (const SweepCurve& curve : Summary(TestSweep("")).curves) {
    for (const statistics::LogisticFit& fit : curve.fits) {
      EXPECT_EQ(fit.clusters, 0);
      EXPECT_EQ(fit.covariance, fit.model_covariance);
    }
  }
}

// The number of trials depends on what they say: only the sequence holds whenever it is looked at.
TEST(SweepSummaryTest, CellsThatARuleEndedShowTheSequence) {
  const scenario::Sweep sweep = TestSweep();
  const auto load = [](std::size_t cell) {
    SweepCellTrials trials = Trials(12, 9.0 + static_cast<double>(cell));
    if (cell != 1) return trials;
    trials.stopping.emplace();
    trials.stopping->end = "precise";
    trials.stopping->trials = kTrials;
    return trials;
  };
  const SweepSummary summary = SummarizeSweep(sweep, load, statistics::IntervalMethod::kWilson);
  const auto expect = [](const SweepRate& rate, std::int64_t count) {
    const auto alone = statistics::ConfidenceSequence(count, kTrials - 1, 0.95);
    const auto all = statistics::ConfidenceSequence(count, kTrials - 1, 1.0 - 0.05 / 8.0);
    EXPECT_EQ(rate.rate.interval.low, alone.low);
    EXPECT_EQ(rate.rate.interval.high, alone.high);
    EXPECT_EQ(rate.simultaneous.low, all.low);
    EXPECT_EQ(rate.simultaneous.high, all.high);
  };
  expect(summary.cells[1].declared_success, 24);
  expect(summary.cells[1].true_success, 12);
  const statistics::Interval planned = summary.cells[0].true_success.rate.interval;
  EXPECT_EQ(planned.low, statistics::ProportionInterval(12, kTrials - 1, 0.95,
                                                        statistics::IntervalMethod::kWilson)
                             .low);
  const statistics::Interval sequence = summary.cells[1].true_success.rate.interval;
  EXPECT_GT(sequence.high - sequence.low, 1.3 * (planned.high - planned.low));
  // The interval shown: in the file, the table and the drawing.
  EXPECT_THAT(SweepCellsCsv(sweep, summary),
              HasSubstr(fmt::format(",{},{},", CsvNumber(sequence.low), CsvNumber(sequence.high))));
  const std::string text = SweepText(sweep, summary, {}, TextStyle::kPlain);
  EXPECT_THAT(text, HasSubstr(fmt::format("({:5.1f} ..{:6.1f})", 100.0 * sequence.low,
                                          100.0 * sequence.high)));
  EXPECT_THAT(text, HasSubstr("confidence sequences"));
  const SweepSummary without = SummarizeSweep(
      sweep, [](std::size_t) { return Trials(12, 9.0); }, statistics::IntervalMethod::kWilson);
  EXPECT_NE(SweepSvg(sweep, summary), SweepSvg(sweep, without));
  EXPECT_THAT(SweepText(sweep, without, {}, TextStyle::kPlain),
              Not(HasSubstr("confidence sequences")));
}

// Trials of 8 that share a layout end alike: 5 layouts say what 5 trials say.
TEST(SweepSummaryTest, TrialsThatShareLayoutsSayLess) {
  const auto load = [](std::size_t cell) {
    SweepCellTrials trials = Trials(0, 9.0);
    trials.trial_hash = std::to_string(cell);
    for (truth::Record& record : trials.prefix) {
      const bool arrives = record.trial / 8 < 1 + cell % 4;
      if (!IsFault(record) && arrives) record.outcome = TrialOutcome::kGoalReached;
    }
    return trials;
  };
  const scenario::Sweep alone = TestSweep();
  const scenario::Sweep shared =
      TestSweep(R"("common_random_numbers": true, "set": {"course.trials_per_layout": 8},)");
  const SweepSummary a = SummarizeSweep(alone, load, statistics::IntervalMethod::kWilson);
  const SweepSummary b = SummarizeSweep(shared, load, statistics::IntervalMethod::kWilson);
  const auto width = [](const statistics::Interval& interval) {
    return interval.high - interval.low;
  };
  for (std::size_t i = 0; i < 8; ++i) {
    const statistics::Interval five = statistics::ProportionInterval(
        1 + static_cast<std::int64_t>(i % 4), 5, 0.95, statistics::IntervalMethod::kClopperPearson);
    EXPECT_GT(width(b.cells[i].true_success.rate.interval), 0.9 * width(five)) << i;
    EXPECT_LT(width(a.cells[i].true_success.rate.interval), 0.5 * width(five)) << i;
    EXPECT_GE(width(b.cells[i].true_success.simultaneous),
              width(b.cells[i].true_success.rate.interval));
    EXPECT_GT(width(b.differences[i].success.interval),
              1.5 * width(a.differences[i].success.interval));
    EXPECT_TRUE(std::isnan(b.differences[i].success.p_value));
    EXPECT_TRUE(std::isnan(b.differences[i].adjusted_p));
  }
  EXPECT_EQ(b.curves[0].fits[1].clusters, 5);
  EXPECT_TRUE(std::isnan(b.curves[0].fits[1].p_value));
  const std::string text = SweepText(shared, b, {}, TextStyle::kPlain);
  EXPECT_THAT(text, HasSubstr("trials share layouts"));
  for (const std::string& line : Lines(text)) EXPECT_LE(line.size(), 100u) << line;
  for (const std::string& file : {text, SweepDifferencesCsv(b), SweepFitsCsv(b)}) {
    EXPECT_THAT(file, Not(HasSubstr("nan")));
  }
  EXPECT_TRUE(json::parse(SweepJson(shared, b, {}))["differences"][0]["p_value"].is_null());
}

TEST(SweepSummaryTest, ACellWithoutTrialsIsNoProblem) {
  const scenario::Sweep sweep = TestSweep();
  const SweepSummary summary = SummarizeSweep(
      sweep,
      [](std::size_t) {
        SweepCellTrials trials = Trials(1, 9.0);
        trials.prefix.clear();
        return trials;
      },
      statistics::IntervalMethod::kWilson);
  EXPECT_EQ(summary.curves[0].fits[0].status, statistics::FitStatus::kTooFewPoints);
  EXPECT_THAT(SweepText(sweep, summary, {}, TextStyle::kPlain), HasSubstr("fewer than two cells"));
  EXPECT_THAT(SweepCellsCsv(sweep, summary), Not(HasSubstr("nan")));
  EXPECT_FALSE(SweepSvg(sweep, summary).empty());
}

TEST(SweepFilesTest, TheTableFitsTheTerminal) {
  const scenario::Sweep sweep = TestSweep();
  const std::string text =
      SweepText(sweep, Summary(sweep), {.trial_hash = "feed"}, TextStyle::kPlain);
  for (const std::string& line : Lines(text)) EXPECT_LE(line.size(), 100u) << line;
  EXPECT_THAT(text, HasSubstr("320 of 320 trials"));
  EXPECT_THAT(text, HasSubstr("8 simulator faults"));
  EXPECT_THAT(text, HasSubstr("90 % at"));
  EXPECT_THAT(text, HasSubstr("95 % intervals, with common random numbers"));
  EXPECT_THAT(text, HasSubstr("Holm over all 8"));
  EXPECT_THAT(text, HasSubstr("trial hash feed"));
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

TEST(SweepFilesTest, EveryLineOfACsvHasAsManyFieldsAsItsHead) {
  const scenario::Sweep sweep = TestSweep();
  const SweepSummary summary = Summary(sweep);
  for (const std::string& csv : {SweepCurvesCsv(sweep, summary), SweepFitCsv(summary),
                                 SweepFitsCsv(summary), SweepDifferencesCsv(summary)}) {
    const std::vector<std::string> lines = Lines(csv);
    ASSERT_GE(lines.size(), 3u);
    for (const std::string& line : lines) {
      EXPECT_EQ(std::count(line.begin(), line.end(), ','),
                std::count(lines[0].begin(), lines[0].end(), ','))
          << line;
    }
  }
  const std::vector<std::string> cells = Lines(SweepCellsCsv(sweep, summary));
  ASSERT_EQ(cells.size(), 9u);
  // The name of a cell holds a comma itself.
  EXPECT_EQ(std::count(cells[1].begin(), cells[1].end(), ','),
            1 + std::count(cells[0].begin(), cells[0].end(), ','));
  EXPECT_THAT(cells[1], HasSubstr("\"navigator=a,k_per_m2=0.002\",a,0.002,1,40,40,40,1,18,18,"));
}

TEST(SweepFilesTest, TheDrawingHasEveryPointAndEscapesNames) {
  const scenario::Sweep sweep = TestSweep();
  const std::string svg = SweepSvg(sweep, Summary(sweep));
  EXPECT_THAT(svg, HasSubstr("&lt;test&gt;"));
  EXPECT_THAT(svg, Not(HasSubstr("<test>")));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  std::size_t circles = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1)) {
    ++circles;
  }
  EXPECT_EQ(circles, 4u * 2u + 1u) << "four cells of navigator a, two panels, the legend";
}

TEST(SweepFilesTest, JsonHoldsCellsFitsAndDifferences) {
  const scenario::Sweep sweep = TestSweep();
  const json summary = json::parse(SweepJson(sweep, Summary(sweep), {.trial_hash = "feed"}));
  EXPECT_EQ(summary["kind"], "sweep");
  EXPECT_EQ(summary["trials"]["completed"], 320);
  EXPECT_EQ(summary["trials"]["faults"], 8);
  EXPECT_EQ(summary["cells"][0]["levels"]["k_per_m2"], 0.002);
  EXPECT_EQ(summary["cells"][0]["true_success"]["count"], 18);
  EXPECT_EQ(summary["fits"].size(), 4u);
  EXPECT_EQ(summary["fits"][0]["crossings"][1]["rate"], 0.5);
  EXPECT_EQ(summary["differences"].size(), 8u);
}

}  // namespace
}  // namespace rockyard::report
