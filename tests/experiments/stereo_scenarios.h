// Small scenarios of the experiment "stereo_sensing" for tests.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/scenario_experiment.h"
#include "scenario/shipped.h"
#include "truth/record.h"

namespace rockyard::experiments {

// A shipped scenario with changes.
inline scenario::Scenario StereoScenario(const std::string& name,
                                         const std::vector<std::string>& overrides = {}) {
  return scenario::Shipped("stereo_sensing/" + name, overrides);
}

// The error model without any error, all distances in one cell.
inline const std::vector<std::string> kWithoutErrors{
    "sensors.stereo.fidelity=error_model",  "sensors.stereo.disparity_noise_px=0",
    "sensors.stereo.dropout_probability=0", "sensors.stereo.edge_dropout_probability=0",
    "stereo_sensing.looks_per_run=1",       "stereo_sensing.distances_m=[0.5, 4]"};

// Columns of the first runs, added up.
class StereoCounts {
 public:
  StereoCounts(const scenario::Scenario& scenario, std::uint64_t runs, std::uint64_t seed = 1) {
    const auto experiment = MakeExperiment(scenario);
    schema_ = experiment->schema();
    sums_.assign(schema_.size(), 0.0);
    for (std::uint64_t run = 0; run < runs; ++run) {
      const truth::Record record = Measure(*experiment, seed, run);
      for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += record.values.at(i);
    }
  }

  double operator[](const std::string& column) const {
    return sums_.at(statistics::ColumnIndex(schema_, column).value());
  }

 private:
  truth::RecordSchema schema_;
  std::vector<double> sums_;
};

}  // namespace rockyard::experiments
