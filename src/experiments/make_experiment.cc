// The registry of experiments: how each is made, and the columns by which a store knows its
// records.
#include "experiments/make_experiment.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "experiments/cylinder_sighting/cylinder_sighting.h"
#include "experiments/dead_reckoning/dead_reckoning.h"
#include "experiments/designation/designation.h"
#include "experiments/drive/drive_experiment.h"
#include "experiments/hazard_detection/hazard_detection.h"
#include "experiments/mission/mission_experiment.h"
#include "experiments/stereo_sensing/stereo_sensing.h"
#include "experiments/three_rock_run/three_rock_run.h"
#include "experiments/visual_motion/visual_motion.h"
#include "truth/measurement_record.h"

namespace rockyard::experiments {

std::unique_ptr<Experiment> MakeExperiment(const ExperimentParams& experiment,
                                           const trial::DriveParams& drive,
                                           const trial::Watchers& watchers) {
  switch (experiment.kind) {
    case ExperimentKind::kDrive:
      return std::make_unique<DriveExperiment>(drive, watchers);
    case ExperimentKind::kHazardDetection:
      return MakeHazardDetection(experiment.hazard_detection, drive, watchers.scan);
    case ExperimentKind::kStereoSensing:
      return std::make_unique<StereoSensingExperiment>(experiment.stereo_sensing, drive);
    case ExperimentKind::kDeadReckoning:
      return std::make_unique<DeadReckoningExperiment>(experiment.dead_reckoning, drive);
    case ExperimentKind::kThreeRockRun:
      return std::make_unique<ThreeRockRunExperiment>(experiment.three_rock_run, drive);
    case ExperimentKind::kDesignation:
      return std::make_unique<DesignationExperiment>(experiment.designation, drive.course);
    case ExperimentKind::kVisualMotion:
      return std::make_unique<VisualMotionExperiment>(experiment.visual_motion, drive);
    case ExperimentKind::kCylinderSighting:
      return std::make_unique<CylinderSightingExperiment>(experiment.cylinder_sighting);
    case ExperimentKind::kMission:
      return std::make_unique<MissionExperiment>(experiment.mission, drive);
  }
  throw std::logic_error("unknown experiment");
}

// A store's column is known by its name alone: a column that is renamed has no role in stored runs
// any more. Where experiments know equally many names, the first of the list counts.
truth::RecordSchema WithRoles(truth::RecordSchema stored) {
  const truth::RecordSchema* best = nullptr;
  std::ptrdiff_t most = 0;
  for (const truth::RecordSchema* columns :
       {&DriveSchema(), &HazardColumns(), &StereoColumns(), &DeadReckoningColumns(),
        &ThreeRockColumns(), &DesignationColumns(), &VisualMotionColumns(),
        &CylinderSightingColumns(), &MissionColumns()}) {
    const auto known = std::count_if(
        stored.begin(), stored.end(),
        [&](const truth::ValueInfo& column) { return truth::FindColumn(*columns, column.name); });
    if (known > most) best = columns;
    most = std::max(most, known);
  }
  if (best == nullptr) return stored;
  for (truth::ValueInfo& column : stored) {
    const truth::ValueInfo* known = truth::FindColumn(*best, column.name);
    if (known == nullptr) continue;
    column.role = known->role;
    column.of = known->of;
  }
  return stored;
}

}  // namespace rockyard::experiments
