// Sweeps whose trials are not independent, or not planned: what their intervals allow for.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "report/csv.h"
#include "report/sample_sweep.h"
#include "report/sweep_files.h"
#include "report/sweep_summary.h"

namespace rockyard::report {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using truth::TrialOutcome;

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
