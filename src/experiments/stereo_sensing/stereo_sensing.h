// The experiment "stereo_sensing": what stereo cameras measure, miss and imagine, at whichever
// fidelity the scenario has.
//
// One run is a block of looks of one cell; run i belongs to cell i modulo their number, so that
// every prefix of the runs covers the cells evenly. Its record holds the cell's factors, then
// counts and sums; its outcome is `measured`.
#pragma once

#include <memory>
#include <vector>

#include "core/random.h"
#include "experiments/cell_experiment.h"
#include "experiments/experiment.h"
#include "experiments/stereo_sensing/stereo_sensing_params.h"
#include "experiments/stereo_sensing/stereo_sums.h"
#include "trial/drive_params.h"
#include "truth/record.h"

namespace rockyard::experiments {

// Every column but the number of the cell: first the factors that name a cell, of which a scenario
// has those of its lists (StereoSensingParams::Factors), then those of StereoSums.
const truth::RecordSchema& StereoColumns();

class StereoSensingExperiment final : public CellExperiment {
 public:
  // Cost of a run: that of the looks, 30 ms more each for the truth, and 0.1 s for cameras that
  // take images.
  StereoSensingExperiment(const StereoSensingParams& params, const trial::DriveParams& drive);
  ~StereoSensingExperiment() override;

 private:
  struct Cell;

  std::vector<double> Measure(std::size_t number, core::TrialKey key) const override;

  StereoSensingParams params_;
  std::vector<Cell> cells_;
};

}  // namespace rockyard::experiments
