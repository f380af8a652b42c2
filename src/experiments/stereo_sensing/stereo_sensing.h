// The experiment "stereo_sensing" (make_experiment.cc): what stereo cameras measure, miss and
// imagine, at whichever fidelity the scenario has. A scene is a look from a random place.
//
// Range r is the distance from the left camera along the ray, depth Z that along the optical axis;
// a bin of distances is one of ranges.
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

// Returns every column but the number of the cell: first the factors that name a cell, of which a
// scenario has those of its lists (StereoSensingParams::Factors), then those of StereoSums.
const truth::RecordSchema& StereoColumns();

class StereoSensingExperiment final : public CellExperiment {
 public:
  // Randomness: terrain and place (RandomPlace) are drawn under the key of each look; faults of the
  // cameras and noise of the looks, by their numbers, under that of the run. Cost of a run: that of
  // the looks, 30 ms more for the truth of each look, and 0.1 s for cameras
  // that take images.
  StereoSensingExperiment(const StereoSensingParams& params, const trial::DriveParams& drive);
  ~StereoSensingExperiment() override;

 private:
  struct Cell;

  std::vector<double> Measure(std::size_t number, core::TrialKey key) const override;

  StereoSensingParams params_;
  std::vector<Cell> cells_;
};

}  // namespace rockyard::experiments
