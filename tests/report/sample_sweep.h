// A sweep of made-up trials.
#pragma once

#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "report/sweep_summary.h"
#include "scenario/sweep.h"

namespace rockyard::report {

inline constexpr std::int64_t kTrials = 40;

// Navigators a and b at four abundances, with common random numbers.
inline scenario::Sweep TestSweep(std::string_view extra = R"("common_random_numbers": true,)") {
  return scenario::ParseSweep(std::string(R"({"name": "<test>", "trials": 40, )") +
                              std::string(extra) + R"(
    "axes": [{"name": "navigator", "levels": [{"name": "a"},
                                              {"name": "b", "set": {"course.goal_radius_m": 0.7}}]},
             {"path": "terrain.rocks.k_per_m2", "values": [0.002, 0.004, 0.008, 0.016]}]})");
}

// Trials of a cell: that many truly arrive, as many again falsely, one is a fault, the rest are
// stuck.
inline SweepCellTrials Trials(std::int64_t arrived, double distance_m) {
  SweepCellTrials trials;
  trials.schema = {{"true_distance_m", "m", ""}, {"displacement_m", "m", ""}};
  trials.planned = kTrials;
  trials.stored = kTrials;
  for (std::int64_t i = 0; i < kTrials; ++i) {
    truth::Record record{.trial = static_cast<std::uint64_t>(i),
                         .outcome = truth::TrialOutcome::kJammed,
                         .detail = "",
                         .values = {distance_m, 8.0}};
    if (i < 2 * arrived) {
      record.outcome =
          i % 2 == 0 ? truth::TrialOutcome::kGoalReached : truth::TrialOutcome::kFalseGoal;
    }
    if (i == kTrials - 1) record = truth::MakeFault(1, static_cast<std::uint64_t>(i), "made up");
    trials.prefix.push_back(record);
  }
  trials.trial_hash = std::to_string(arrived) + "/" + std::to_string(distance_m);
  return trials;
}

// Cell i of the sweep: b does better at every abundance but the last.
inline SweepSummary Summary(const scenario::Sweep& sweep) {
  const std::vector<std::int64_t> arrived{18, 12, 5, 0, 19, 15, 10, 0};
  return SummarizeSweep(
      sweep,
      [&](std::size_t cell) { return Trials(arrived[cell], 10.0 + static_cast<double>(cell)); },
      statistics::IntervalMethod::kWilson);
}

inline std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace rockyard::report
