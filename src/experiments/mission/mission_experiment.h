// The experiment "mission": one run is one mission of many sols.
//
// Its outcome is `measured`; MissionColumns lists what is counted. With mission.sol_columns a block
// of columns for every sol follows, NaN after the last one.
#pragma once

#include <cstdint>

#include "experiments/experiment.h"
#include "experiments/mission/mission_params.h"
#include "trial/drive_params.h"
#include "truth/record.h"

namespace rockyard::experiments {

// Every column but the number of the cell and those of sols (mission.sol_columns), in the order of
// ForEachMissionColumn (mission_record.h).
const truth::RecordSchema& MissionColumns();

class MissionExperiment final : public Experiment {
 public:
  MissionExperiment(const MissionParams& params, trial::DriveParams drive);

  const truth::RecordSchema& schema() const override { return schema_; }
  truth::Record Run(std::uint64_t seed, std::uint64_t index) const override;

 private:
  MissionParams params_;
  trial::DriveParams drive_;
  truth::RecordSchema schema_;
};

}  // namespace rockyard::experiments
