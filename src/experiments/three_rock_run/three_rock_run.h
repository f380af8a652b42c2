// The experiment "three_rock_run": drives like the one of Matthies 1995, figures 7 and 8.
//
// One run draws a goal and rock A, and drives. Where that goes as the published run is told, it
// draws places of rock B beside the way that the rover took, until a drive among both goes as told,
// then likewise of C. A drive depends on no rock that it has not come to, so that the last one is a
// drive among all three. The outcome of a run is `measured`; conditions, tries and errors are
// columns.
#pragma once

#include "experiments/experiment.h"
#include "experiments/three_rock_run/three_rock_record.h"
#include "trial/drive_params.h"
#include "truth/record.h"

namespace rockyard::experiments {

// Every column but the number of the cell, in the order of ThreeRockRecord (three_rock_record.h).
const truth::RecordSchema& ThreeRockColumns();

class ThreeRockRunExperiment final : public Experiment {
 public:
  // The rocks and the goal of `drive` are replaced.
  ThreeRockRunExperiment(const ThreeRockRunParams& params, trial::DriveParams drive);

  const truth::RecordSchema& schema() const override { return schema_; }
  truth::Record Run(std::uint64_t seed, std::uint64_t index) const override;

 private:
  struct Driven;

  struct Course;  // a goal, and rocks so far

  ThreeRockRecord Measure(core::TrialKey key) const;
  Driven DriveAmong(const Course& course) const;
  // They try places of a rock until the drive goes as told, and say whether it did.
  bool TrySecondRock(const RunHistory& with_a, Course& course, ThreeRockRecord& record) const;
  bool TryThirdRock(const RunHistory& with_b, Course& course, ThreeRockRecord& record) const;

  ThreeRockRunParams params_;
  trial::DriveParams drive_;
  RoverZone array_;
  RoverZone body_;
  truth::RecordSchema schema_;
};

}  // namespace rockyard::experiments
