// A sweep of made-up trials: what its files say, and what its intervals allow for where trials are
// not independent, or not planned.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/count_of.h"
#include "core/says.h"
#include "report/result_table.h"
#include "report/sample_run.h"
#include "report/sample_sweep.h"
#include "report/sweep_files.h"
#include "report/sweep_summary.h"

namespace rockyard::report {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using truth::TrialOutcome;

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

// How long drives may go on is a choice: where it decided, the table says how much hangs on it.
TEST(SweepFilesTest, SaysHowManyDrivesALimitEnded) {
  const scenario::Sweep sweep = TestSweep();
  const SweepSummary summary = SummarizeSweep(
      sweep,
      [&](std::size_t cell) {
        SweepCellTrials trials = Trials(10, 9.0);
        for (std::size_t i = 20; i < 20 + 2 * cell; ++i) {
          trials.prefix[i].outcome = truth::TrialOutcome::kNoPath;
          trials.prefix[i].detail =
              truth::Info(i % 2 == 0 ? truth::EndCause::kPatienceTime : truth::EndCause::kGaveUp)
                  .sentence;
        }
        return trials;
      },
      statistics::IntervalMethod::kWilson);
  EXPECT_EQ(summary.cells[7].ended_by_limit.count, 7);
  const std::string text = SweepText(sweep, summary, {}, TextStyle::kPlain);
  EXPECT_THAT(text, core::Says("in 7 of 8 cells drives were ended by a limit", "up to 17.9 %"));
  EXPECT_TRUE(Lines(SweepCellsCsv(sweep, summary))[8].ends_with(",7"));
  EXPECT_THAT(SweepText(sweep, Summary(sweep), {}, TextStyle::kPlain),
              Not(HasSubstr("ended by a limit")));
}

TEST(SweepFilesTest, TheTableFitsTheTerminal) {
  const scenario::Sweep sweep = TestSweep();
  const std::string text =
      SweepText(sweep, Summary(sweep), {.trial_hash = "feed"}, TextStyle::kPlain);
  for (const std::string& line : Lines(text)) EXPECT_LE(line.size(), 100u) << line;
  EXPECT_THAT(text, core::Says("320 of 320 trials", "8 simulator faults", "90 % at",
                               "95 % intervals, with common random numbers", "Holm over all 8",
                               "trial hash feed"));
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

TEST(SweepFilesTest, TheTableFitsWhateverTheNumbersAre) {
  constexpr std::int64_t kMax = 1'000'000'000;
  scenario::Sweep sweep = TestSweep();
  sweep.name = "odd\n\x1b[31m" + std::string(300, 'n');
  sweep.seed = 9'000'000'000'000'000'000U;
  SweepSummary summary = Summary(sweep);
  summary.notes = {"a note\nof many words: " + std::string(90, 'n') + " " + std::string(90, 'm')};
  for (SweepCellSummary& cell : summary.cells) {
    cell.completed = cell.planned = kMax;
    cell.accounting = {kMax, kMax, kMax, kMax, kMax};
    cell.stopping = LargestStopping();
    for (statistics::MetricSummary& metric : cell.metrics) metric.mean = 1.5e200;
  }
  for (SweepDifference& each : summary.differences) {
    each.first = each.second = each.at = std::string(60, 'd');
    each.adjusted_p = 1e-200;
  }
  const std::string text = SweepText(sweep, summary, {.trial_hash = "feed"}, TextStyle::kPlain);
  for (const std::string& line : Lines(text)) EXPECT_LE(line.size(), 100u) << line;
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_THAT(text, HasSubstr("p < 1e-09"));
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
  EXPECT_EQ(core::CountOf(svg, "<circle"), 4 * 2 + 1)
      << "four cells of navigator a, two panels, the legend";
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

TEST(SweepDependenceTest, FitsKnowWhichTrialsHangTogether) {
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

// The number of trials depends on what they say, which the interval shown allows for.
TEST(SweepDependenceTest, CellsThatARuleEndedShowItsInterval) {
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
    const auto interval = [count](double confidence) {
      return statistics::ProportionInterval(count, kTrials - 1, confidence,
                                            statistics::IntervalMethod::kStopped);
    };
    const auto alone = interval(0.95);
    const auto all = interval(1.0 - 0.05 / 8.0);
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
  const statistics::Interval stopped = summary.cells[1].true_success.rate.interval;
  EXPECT_GT(stopped.high - stopped.low, 1.05 * (planned.high - planned.low));
  // The interval shown: in the file, the table and the drawing.
  EXPECT_THAT(SweepCellsCsv(sweep, summary),
              HasSubstr(fmt::format(",{},{},", CsvNumber(stopped.low), CsvNumber(stopped.high))));
  const std::string text = SweepText(sweep, summary, {}, TextStyle::kPlain);
  EXPECT_THAT(text, HasSubstr(fmt::format("({:5.1f} ..{:6.1f})", 100.0 * stopped.low,
                                          100.0 * stopped.high)));
  EXPECT_THAT(text, HasSubstr("allow for it"));
  const SweepSummary without = SummarizeSweep(
      sweep, [](std::size_t) { return Trials(12, 9.0); }, statistics::IntervalMethod::kWilson);
  EXPECT_NE(SweepSvg(sweep, summary), SweepSvg(sweep, without));
  EXPECT_THAT(SweepText(sweep, without, {}, TextStyle::kPlain), Not(HasSubstr("allow for it")));
}

// Trials of 8 that share a layout end alike: 5 layouts say what 5 trials say.
TEST(SweepDependenceTest, TrialsThatShareLayoutsSayLess) {
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

}  // namespace
}  // namespace rockyard::report
