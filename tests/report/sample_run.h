// A run of six trials whose every number can be checked by hand.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/atomic_file.h"
#include "report/run_description.h"
#include "truth/record.h"

namespace rockyard::report {

inline truth::RecordSchema SampleSchema() {
  return {{"true_distance_m", "m", "path"},
          {"displacement_m", "m", "start to end"},
          {"distance_error_percent", "%", "odometer"},
          {"heading_error_deg", "deg", "heading"},
          {"position_error_m", "m", "position"},
          {"sim_time_s", "s", "time"},
          {"energy_wh", "Wh", "energy"},
          {"rocks", "1", "rocks"}};
}

inline std::vector<truth::Record> SampleRecords() {
  using truth::TrialOutcome;
  const double nan = std::nan("");
  return {{0, TrialOutcome::kGoalReached, "arrived", {8.0, 7.6, 1.0, 2.0, 0.3, 100.0, 1.0, 5.0}},
          {1, TrialOutcome::kFalseGoal, "believed, \"only\"", {9.0, 7.6, 3, 4, 0.5, 200, 2, 5}},
          {2, TrialOutcome::kNoPath, "nowhere to go", {4.0, 7.6, 2.0, nan, 0.1, 300.0, 3.0, 6.0}},
          {3, TrialOutcome::kSimulatorFault, "blew up", {}},
          {4, TrialOutcome::kTimeLimit, "too long", {6.0, 7.6, 5.0, 6.0, 0.7, 400.0, 4.0, 7.0}},
          {5, TrialOutcome::kGoalReached, "arrived", {8.0, 7.6, 4.0, 3.0, 0.2, 500.0, 5.0, 8.0}}};
}

// What a writer of pieces wrote.
inline std::string WrittenBy(void (*write)(const truth::RecordSchema&,
                                           std::span<const truth::Record>, const TextSink&),
                             const truth::RecordSchema& schema,
                             const std::vector<truth::Record>& records) {
  std::string text;
  write(schema, records, [&](std::string_view piece) { text += piece; });
  return text;
}

// Every number as large as any run's.
inline StoppingReport LargestStopping() {
  constexpr std::int64_t kMax = 1'000'000'000;
  return {.half_width = 0.49,
          .max_trials = kMax,
          .block = 1000000,
          .confidence = 0.95,
          .allocation = "adaptive",
          .budget = 0,
          .end = "max_trials",
          .trials = kMax,
          .drives = kMax,
          .successes = kMax,
          .low = 0.0,
          .high = 1.0};
}

inline RunDescription SampleDescription() {
  RunDescription run;
  run.scenario = "sample";
  run.fingerprint = "00ff";
  run.resolved = "{\"name\": \"sample\", \"k\": 0.1}";
  run.localization = "dead_reckoning";
  run.seed = 9000000000000000001ULL;
  run.planned = 8;
  run.stored = 7;
  run.trial_hash = "0123456789abcdef";
  run.provenance.version = "0.1.0";
  run.provenance.commit = "abc";
  run.builds = {"0.1.0 abc"};
  run.threads = 2;
  return run;
}

}  // namespace rockyard::report
