// Small scenarios of the experiment "hazard_detection" for tests.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/scenario_experiment.h"
#include "scenario/shipped.h"
#include "statistics/drive_summary.h"
#include "truth/record.h"

namespace rockyard::experiments {

// A shipped scenario with changes.
inline scenario::Scenario HazardScenario(const std::string& name,
                                         std::vector<std::string> overrides = {}) {
  return scenario::Shipped("hazard_detection/" + name, overrides);
}

// A value of a record by the name of its column.
inline double ValueOf(const truth::RecordSchema& schema, const truth::Record& record,
                      const std::string& name) {
  return record.values.at(statistics::ColumnIndex(schema, name).value());
}

// One column of run 0, added up over the given number of scenes.
inline double Count(const scenario::Scenario& scenario, const std::string& column,
                    std::uint64_t run = 0) {
  const auto experiment = MakeExperiment(scenario);
  const truth::Record record = experiment->Run(1, run);
  EXPECT_EQ(record.outcome, truth::TrialOutcome::kMeasured) << record.detail;
  return ValueOf(experiment->schema(), record, column);
}

// Both lists of overrides.
inline std::vector<std::string> With(std::vector<std::string> all,
                                     const std::vector<std::string>& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace rockyard::experiments
