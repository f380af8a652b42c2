// The experiment "three_rock_run": drives like the one of Matthies 1995, figures 7 and 8.
//
// One run draws a layout of three rocks and drives among them: with A alone, then with B where the
// rover came by, then with C, as long as each drive goes as the published one is told. A drive
// depends on no rock that it has not come to, so that the last one is a drive among all three. Its
// outcome is `measured`; the conditions and errors are columns (columns.h).
#pragma once

#include <span>

#include "experiments/experiment.h"
#include "experiments/three_rock_run/three_rock_record.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

class ThreeRockRunExperiment final : public Experiment {
 public:
  // The rocks and the goal of `drive` are replaced.
  ThreeRockRunExperiment(const ThreeRockRunParams& params, trial::DriveParams drive);

  const truth::RecordSchema& schema() const override { return schema_; }
  truth::Record Run(std::uint64_t seed, std::uint64_t index) const override;

 private:
  struct Driven;

  ThreeRockRecord Measure(core::TrialKey key) const;
  Driven DriveAmong(std::span<const PlacedRock> rocks, double goal_m, core::TrialKey key) const;

  ThreeRockRunParams params_;
  trial::DriveParams drive_;
  RoverZone array_;
  RoverZone body_;
  truth::RecordSchema schema_;
};

}  // namespace rockyard::experiments
