// Baselines as files, and the table of metrics in README.md.
#include "report/baseline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <vector>

#include "core/json_text.h"
#include "core/refusals.h"
#include "report/parameter_table.h"

namespace rockyard::report {
namespace {

Baseline SampleBaseline() {
  using truth::TrialOutcome;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const truth::RecordSchema schema = {{"max_tilt_deg", "deg", ""}, {"sim_time_s", "s", ""}};
  const std::vector<truth::Record> records = {{0, TrialOutcome::kGoalReached, "", {5.1234567, 10}},
                                              {1, TrialOutcome::kJammed, "", {nan, 20}},
                                              {2, TrialOutcome::kSimulatorFault, "", {}}};
  BaselineCell cell{.name = "a \"cell\"",
                    .scenario = "s",
                    .fingerprint = "f",
                    .resolved = "{\"k\": 1}",
                    .seed = 9000000000000000001ULL,
                    .trial_hash = "h",
                    .outcomes = {},
                    .metrics = {}};
  FillBaselineCell(schema, records, cell);
  return {.name = "n", .reason = "because", .build = "b", .cells = {cell}};
}

TEST(Baseline, ReadsBackWhatWasWritten) {
  const Baseline before = SampleBaseline();
  const core::JsonValue json = core::ParseJson(BaselineJson(before), "baseline");
  ASSERT_TRUE(IsBaseline(json));
  const Baseline after = ParseBaseline(json);
  ASSERT_EQ(after.cells.size(), 1u);
  EXPECT_EQ(after.cells[0].name, "a \"cell\"");
  EXPECT_EQ(after.cells[0].seed, 9000000000000000001ULL);
  EXPECT_EQ(after.cells[0].outcomes, before.cells[0].outcomes);
  ASSERT_EQ(after.cells[0].metrics.size(), before.cells[0].metrics.size());
  for (std::size_t i = 0; i < after.cells[0].metrics.size(); ++i) {
    const statistics::BaselineMetric& a = before.cells[0].metrics[i];
    const statistics::BaselineMetric& b = after.cells[0].metrics[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.margin, b.margin);
    ASSERT_EQ(b.values.size(), 3u);
    for (std::size_t t = 0; t < 3; ++t) {
      EXPECT_TRUE(a.values[t] == b.values[t] ||
                  (std::isnan(a.values[t]) && std::isnan(b.values[t])));
    }
  }
}

// A mean of 0 gives a relative margin no scale; the file must still be one that can be read.
TEST(Baseline, AMetricThatIsAlwaysZeroHasAMargin) {
  const truth::RecordSchema schema = {{"true_distance_m", "m", ""}};
  const std::vector<truth::Record> records = {{0, truth::TrialOutcome::kJammed, "", {0.0}},
                                              {1, truth::TrialOutcome::kJammed, "", {0.0}}};
  Baseline still = SampleBaseline();
  BaselineCell& cell = still.cells[0];
  cell.outcomes.clear();
  cell.metrics.clear();
  FillBaselineCell(schema, records, cell);
  const Baseline read = ParseBaseline(core::ParseJson(BaselineJson(still), "baseline"));
  for (const statistics::BaselineMetric& metric : read.cells.at(0).metrics) {
    EXPECT_GT(metric.margin, 0.0) << metric.name;
  }
  EXPECT_EQ(read.cells[0].metrics.back().values, std::vector<double>(2, 0.0));
}

TEST(Baseline, EveryMistakeIsNamed) {
  const core::JsonValue json = core::ParseJson(
      R"({"kind": "rockyard_baseline", "schema_version": 2, "name": 1, "reason": "r", "build": "b",
          "cells": [{"name": "c", "scenario": "s", "fingerprint": "f", "trial_hash": "h",
                     "seed": "x", "outcomes": "G?", "resolved": {},
                     "margins": {"max_tilt_deg": 0}, "metrics": {"max_tilt_deg": ["a"]}}]})",
      "baseline");
  EXPECT_EQ(core::ProblemsIn([&] { ParseBaseline(json); }).size(), 6u);
}

TEST(MetricTable, StandsInTheReadme) {
  std::ifstream file(ROCKYARD_SOURCE_DIR "/src/statistics/README.md");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find(MetricTableMarkdown()), std::string::npos)
      << "put the output of rockyard metrics --markdown into src/statistics/README.md";
}

}  // namespace
}  // namespace rockyard::report
