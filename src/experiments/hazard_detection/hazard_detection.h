// The experiment "hazard_detection": what the light stripe sensor sees, misses and imagines.
//
// One run is a block of independent scenes of one cell; run i belongs to cell i modulo their
// number, so that every prefix of the runs covers the cells evenly. Its record holds the cell's
// factors, then counts and sums; its outcome is `measured`.
#pragma once

#include <memory>

#include "experiments/cell_table.h"
#include "experiments/experiment.h"
#include "experiments/hazard_detection/hazard_study.h"
#include "trial/drive_params.h"
#include "truth/record.h"

namespace rockyard::experiments {

// Every column of any study but the number of the cell: first the factors that name a cell, then
// the bases, and counts and sums of these. A study takes those that it measures
// (HazardStudyRunner::columns), and its factors those of their lists (CellFactor::column).
const truth::RecordSchema& HazardColumns();

class HazardDetectionExperiment final : public Experiment {
 public:
  explicit HazardDetectionExperiment(const HazardDetectionParams& params,
                                     const trial::DriveParams& drive,
                                     const trial::ScanWatcher& watcher = {});

  const truth::RecordSchema& schema() const override { return schema_; }
  truth::Record Run(std::uint64_t seed, std::uint64_t index) const override;

 private:
  CellTable table_;
  std::unique_ptr<HazardStudyRunner> study_;
  truth::RecordSchema schema_;
};

}  // namespace rockyard::experiments
