// The experiment "designation": where operators put goals in the lander's stereo images.
//
// One run is a block of independent designations of a goal at one range; run i belongs to cell i
// modulo their number, so that every prefix of the runs covers the cells evenly. Its record holds
// the range, then counts and sums (columns.h); its outcome is `measured`.
#pragma once

#include "core/random.h"
#include "experiments/cell_table.h"
#include "experiments/designation/designation_study_params.h"
#include "experiments/designation/designation_sums.h"
#include "experiments/designation/lander_pair.h"
#include "experiments/experiment.h"
#include "trial/course_params.h"

namespace rockyard::experiments {

class DesignationExperiment final : public Experiment {
 public:
  // `course` holds the errors (course.designation).
  DesignationExperiment(const DesignationStudyParams& params, const trial::CourseParams& course);

  const truth::RecordSchema& schema() const override { return schema_; }
  // Cost: below 1 us a designation. Randomness: kExperiment, and kGoalDesignation for the errors
  // that course.designation draws, under a key of each designation.
  truth::Record Run(std::uint64_t seed, std::uint64_t index) const override;

 private:
  // The course with its start under the mast and its goal at that range.
  trial::CourseParams CourseOf(double range_m) const;
  DesignationSums Measure(double range_m, core::TrialKey key) const;

  DesignationStudyParams params_;
  trial::CourseParams course_;
  LanderCameras cameras_;
  CellTable table_;
  truth::RecordSchema schema_;
};

// The cameras that a scenario gives the lander.
LanderCameras CamerasOf(const DesignationStudyParams& study,
                        const trial::DesignationParams& designation);

}  // namespace rockyard::experiments
