// The experiment "dead_reckoning": how the error of dead reckoning grows along a straight line.
//
// One run is a block of walks of one cell; run i belongs to cell i modulo their number, so that
// every prefix of the runs covers the cells evenly. Its record holds the cell's factors, then
// counts and sums; its outcome is `measured`.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "experiments/cell_table.h"
#include "experiments/dead_reckoning/dead_reckoning_walk_params.h"
#include "experiments/dead_reckoning/noisy_walk.h"
#include "experiments/experiment.h"
#include "trial/drive_params.h"
#include "truth/record.h"

namespace rockyard::experiments {

// Every column but the number of the cell: first the factors that name a cell, then what WalkSums
// holds.
const truth::RecordSchema& DeadReckoningColumns();

class DeadReckoningExperiment final : public Experiment {
 public:
  DeadReckoningExperiment(const DeadReckoningWalkParams& params, const trial::DriveParams& drive);

  const truth::RecordSchema& schema() const override { return schema_; }
  // Cost: 0.15 us a step of every walk.
  truth::Record Run(std::uint64_t seed, std::uint64_t index) const override;

 private:
  WalkSums Measure(const WalkPlan& plan, core::TrialKey key) const;

  DeadReckoningWalkParams params_;
  CellTable table_;
  WalkingRover rover_;
  truth::RecordSchema schema_;
};

// What the walks of one cell have in common. `values` are those of params.Factors().
WalkPlan PlanOf(const DeadReckoningWalkParams& params, const std::vector<double>& values);

}  // namespace rockyard::experiments
