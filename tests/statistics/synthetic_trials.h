// Trials drawn from a known law, for tests of what is computed from trials.
#pragma once

#include <cmath>
#include <numbers>

#include "core/random.h"
#include "statistics/published_comparison.h"
#include "truth/record.h"

namespace rockyard::statistics {

// What differs from trial to trial in the synthetic law. The defaults are near Matthies 1995.
struct SyntheticLaw {
  double success_rate = 0.95;
  double jam_share = 0.5;  // of the failures; the others find no path
  double shortest_m = 7.2;
  double mean_excess_m = 1.2;
  double distance_error_mean_percent = 3.5;
  double distance_error_sd_percent = 2.5;
  double heading_error_sd_deg = 14.0;
};

inline truth::RecordSchema SyntheticSchema() {
  return {{"true_distance_m", "m", "path"},
          {"straight_distance_m", "m", "start to goal"},
          {"distance_error_percent", "%", "odometer"},
          {"heading_error_deg", "deg", "heading"},
          {"position_error_m", "m", "position"},
          {"true_goal_distance_m", "m", "left to go"}};
}

inline truth::Record SyntheticTrial(const SyntheticLaw& law, std::uint64_t seed,
                                    std::uint32_t trial) {
  core::RandomStream stream({.seed = seed, .trial = trial}, core::Purpose::kTest);
  const double distance = law.shortest_m + core::SampleExponential(stream, law.mean_excess_m);
  const double error =
      core::SampleNormal(stream, law.distance_error_mean_percent, law.distance_error_sd_percent);
  const double heading = std::abs(core::SampleNormal(stream, 0.0, law.heading_error_sd_deg));
  const double position = 7.6 * heading * std::numbers::pi / 180.0;
  truth::Record record;
  record.trial = trial;
  if (core::SampleBernoulli(stream, law.success_rate)) {
    record.outcome = truth::TrialOutcome::kGoalReached;
  } else {
    record.outcome = core::SampleBernoulli(stream, law.jam_share) ? truth::TrialOutcome::kJammed
                                                                  : truth::TrialOutcome::kNoPath;
  }
  record.values = {distance, 7.6, error, heading, position, 0.1};
  return record;
}

inline std::vector<truth::Record> SyntheticTrials(const SyntheticLaw& law, std::uint64_t seed,
                                                  std::uint32_t count) {
  std::vector<truth::Record> records;
  for (std::uint32_t i = 0; i < count; ++i) records.push_back(SyntheticTrial(law, seed, i));
  return records;
}

inline ScenarioRun RunOf(std::string scenario, const std::vector<truth::Record>& records) {
  return {.scenario = std::move(scenario), .schema = SyntheticSchema(), .records = records};
}

}  // namespace rockyard::statistics
