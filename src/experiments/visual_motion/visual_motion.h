// The experiment "visual_motion": how well visual odometry measures one motion, at whichever
// fidelity the scenario has.
//
// One run is a block of motions of one cell; run i belongs to cell i modulo their number, so that
// every prefix of the runs covers the cells evenly. Its record holds the cell's factors, then
// counts and sums (columns.h); its outcome is `measured`.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "experiments/cell_table.h"
#include "experiments/experiment.h"
#include "experiments/visual_motion/visual_motion_study_params.h"
#include "experiments/visual_motion/visual_sums.h"
#include "trial/drive_params.h"
#include "trial/visual_eyes.h"

namespace rockyard::experiments {

class VisualMotionExperiment final : public Experiment {
 public:
  VisualMotionExperiment(const VisualMotionStudyParams& params, const trial::DriveParams& drive);

  const truth::RecordSchema& schema() const override { return schema_; }
  // Cost: that of four rendered images a motion, 0.5 s; some microseconds by the error model.
  truth::Record Run(std::uint64_t seed, std::uint64_t index) const override;

 private:
  VisualSums Measure(std::size_t cell, core::TrialKey key) const;

  VisualMotionStudyParams params_;
  CellTable table_;
  std::vector<trial::DriveParams> drives_;  // of each cell
  truth::RecordSchema schema_;
};

// A motion from a place to another one, and where on-board software expects it.
struct StudiedStep {
  math::Transform X_WF = math::Transform::Identity();  // R at first
  math::Transform X_WS = math::Transform::Identity();  // and then
  math::Transform predicted_FS = math::Transform::Identity();
};

// Adds one measured motion to `sums`.
void AddStep(const StudiedStep& step, const vision::MotionResult& seen, VisualSums& sums);

}  // namespace rockyard::experiments
