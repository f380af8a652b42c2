// The list of experiments (experiment_set_params.h). Must stay: names, and the order, in which
// resolved scenarios have the groups of parameters; every fingerprint depends on it, and changes
// where one with parameters is added. The first one is chosen by default.

#include "experiments/arc_planning/arc_planning.h"
#include "experiments/cylinder_sighting/cylinder_sighting.h"
#include "experiments/dead_reckoning/dead_reckoning.h"
#include "experiments/designation/designation.h"
#include "experiments/drive/drive_experiment.h"
#include "experiments/experiment_set_params.h"
#include "experiments/hazard_detection/hazard_detection.h"
#include "experiments/mission/mission_experiment.h"
#include "experiments/stereo_sensing/stereo_sensing.h"
#include "experiments/three_rock_run/three_rock_run.h"
#include "experiments/visual_motion/visual_motion.h"
#include "trial/watchers.h"

namespace rockyard::experiments {
namespace {

using Made = std::unique_ptr<Experiment>;

template <typename Kind, typename Params>
Made Make(const Params& params, const trial::DriveParams& drive, const trial::Watchers&) {
  return std::make_unique<Kind>(params, drive);
}

}  // namespace

ExperimentSet::ExperimentSet()
    : KindSet({.group = "scenario",
               .key = "experiment",
               .one = "an experiment",
               .others = {},
               .choice = core::Setting("what one run is")}) {}

ExperimentSet StandardExperiments() {
  using enum trial::LightStripeUse;
  ExperimentSet set;
  set.Add<core::NoParams>(
      {"drive",
       [](const auto& /*params*/, const auto& drive, auto& v) {
         trial::RequireSoundDrive(drive, v);
       },
       [](const auto& /*params*/, const auto& drive, const auto& watchers) -> Made {
         return std::make_unique<DriveExperiment>(drive, watchers);
       },
       DriveSchema});
  set.Add<HazardDetectionParams>(
      {"hazard_detection", RequireMeasurable, MakeHazardDetection, HazardColumns, kAlways});
  set.Add<StereoSensingParams>(
      {"stereo_sensing", RequireStereoMeasurable, Make<StereoSensingExperiment>, StereoColumns});
  set.Add<DeadReckoningWalkParams>({"dead_reckoning", RequireDeadReckoning,
                                    Make<DeadReckoningExperiment>, DeadReckoningColumns});
  set.Add<ThreeRockRunParams>({"three_rock_run", RequireThreeRockRun, Make<ThreeRockRunExperiment>,
                               ThreeRockColumns, kAlways});
  set.Add<DesignationStudyParams>(
      {"designation", RequireDesignable, Make<DesignationExperiment>, DesignationColumns});
  set.Add<VisualMotionStudyParams>(
      {"visual_motion", RequireVisualMotion, Make<VisualMotionExperiment>, VisualMotionColumns});
  set.Add<CylinderSightingParams>(
      {"cylinder_sighting", RequireSightable,
       [](const auto& params, const auto& /*drive*/, const auto& /*watchers*/) -> Made {
         return std::make_unique<CylinderSightingExperiment>(params);
       },
       CylinderSightingColumns});
  set.Add<MissionParams>({"mission", RequireMission, Make<MissionExperiment>, MissionColumns});
  set.Add<ArcPlanningParams>(
      {"arc_planning", RequireArcPlanning, Make<ArcPlanningExperiment>, ArcPlanningColumns});
  return set;
}

}  // namespace rockyard::experiments
