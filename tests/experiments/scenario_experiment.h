// The experiment of a scenario and its records, for tests that make one from a file or from
// defaults.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "experiments/make_experiment.h"
#include "scenario/scenario.h"
#include "statistics/drive_summary.h"
#include "truth/record.h"

namespace rockyard::experiments {

inline std::unique_ptr<Experiment> MakeExperiment(const scenario::Scenario& scenario,
                                                  const trial::ScanWatcher& watcher = {}) {
  return MakeExperiment(scenario.experiment, scenario.drive, {.scan = watcher});
}

// The record of a run that measures something.
inline truth::Record Measure(const Experiment& experiment, std::uint64_t seed, std::uint64_t run) {
  truth::Record record = experiment.Run(seed, run);
  EXPECT_EQ(record.outcome, truth::TrialOutcome::kMeasured) << record.detail;
  return record;
}

// A value of a record by the name of its column.
inline double ValueOf(const truth::RecordSchema& schema, const truth::Record& record,
                      const std::string& name) {
  return record.values.at(statistics::ColumnIndex(schema, name).value());
}

// Both lists of overrides.
inline std::vector<std::string> With(std::vector<std::string> all,
                                     const std::vector<std::string>& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace rockyard::experiments
