// Which experiment a scenario asks for, and the parameters of each: the one list of experiments, a
// part of every scenario.
//
// A new experiment has a folder beside this file with its parameters, columns and conditions. This
// file and make_experiment.cc have to name it, no other.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"
#include "experiments/cylinder_sighting/cylinder_sighting_params.h"
#include "experiments/dead_reckoning/dead_reckoning_walk_params.h"
#include "experiments/designation/designation_study_params.h"
#include "experiments/hazard_detection/hazard_detection_params.h"
#include "experiments/mission/mission_params.h"
#include "experiments/stereo_sensing/stereo_sensing_params.h"
#include "experiments/three_rock_run/three_rock_run_params.h"
#include "experiments/visual_motion/visual_motion_study_params.h"
#include "trial/drive_checks_params.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

// What one run of the experiment is. Must stay: the names, as scenario files and stored runs hold
// them.
enum class ExperimentKind {
  kDrive,             // the closed-loop drive to a goal
  kHazardDetection,   // what the light stripe sensor sees and misses
  kStereoSensing,     // what stereo cameras measure and miss
  kDeadReckoning,     // how far dead reckoning along a straight line goes wrong
  kThreeRockRun,      // a drive among three rocks that goes as a published one is told
  kDesignation,       // where operators put goals in the lander's images
  kVisualMotion,      // how well visual odometry measures one motion
  kCylinderSighting,  // where the coloured cylinder on the rover is seen from the lander
  kMission,           // sols of drives, one after the other
};

}  // namespace rockyard::experiments

template <>
struct rockyard::core::EnumNames<rockyard::experiments::ExperimentKind> {
  static constexpr std::array<std::string_view, 9> kNames{
      "drive",       "hazard_detection", "stereo_sensing",    "dead_reckoning", "three_rock_run",
      "designation", "visual_motion",    "cylinder_sighting", "mission"};
};

namespace rockyard::experiments {

struct ExperimentParams {
  ExperimentKind kind = ExperimentKind::kDrive;
  HazardDetectionParams hazard_detection;
  StereoSensingParams stereo_sensing;
  DeadReckoningWalkParams dead_reckoning;
  ThreeRockRunParams three_rock_run;
  DesignationStudyParams designation;
  VisualMotionStudyParams visual_motion;
  CylinderSightingParams cylinder_sighting;
  MissionParams mission;

  // VisitKind lists the field "experiment", VisitGroups the group of each experiment that has
  // parameters of its own; both in the group that is being visited.
  void VisitKind(core::FieldVisitor& v) {
    v.Choice("experiment", kind, core::Setting("what one run is"));
  }
  void VisitGroups(core::FieldVisitor& v) {
    v.Group("hazard_detection", hazard_detection, "the experiment of that name");
    v.Group("stereo_sensing", stereo_sensing, "the experiment of that name");
    v.Group("dead_reckoning", dead_reckoning, "the experiment of that name");
    v.Group("three_rock_run", three_rock_run, "the experiment of that name");
    v.Group("designation", designation, "the experiment of that name");
    v.Group("visual_motion", visual_motion, "the experiment of that name");
    v.Group("cylinder_sighting", cylinder_sighting, "the experiment of that name");
    v.Group("mission", mission, "the experiment of that name");
  }

  // Requires of the drive what the experiment in use asks.
  void RequireConsistency(const trial::DriveParams& drive, core::FieldVisitor& v) const {
    const bool stripes =
        kind == ExperimentKind::kHazardDetection || kind == ExperimentKind::kThreeRockRun;
    using Use = trial::LightStripeUse;
    trial::RequireConsistency(drive, stripes ? Use::kAlways : Use::kAsTerrainSensor, v);
    switch (kind) {
      case ExperimentKind::kDrive:
        return trial::RequireSoundDrive(drive, v);
      case ExperimentKind::kHazardDetection:
        return RequireMeasurable(hazard_detection, drive, v);
      case ExperimentKind::kStereoSensing:
        return RequireStereoMeasurable(stereo_sensing, drive, v);
      case ExperimentKind::kDeadReckoning:
        return RequireDeadReckoning(drive, v);
      case ExperimentKind::kThreeRockRun:
        return RequireThreeRockRun(three_rock_run, drive, v);
      case ExperimentKind::kDesignation:
        return RequireDesignable(designation, drive, v);
      case ExperimentKind::kVisualMotion:
        return RequireVisualMotion(visual_motion, drive, v);
      case ExperimentKind::kCylinderSighting:
        return RequireSightable(cylinder_sighting, v);
      case ExperimentKind::kMission:
        trial::RequireSoundDrive(drive, v);
        return RequireMission(mission, drive, v);
    }
  }
};

}  // namespace rockyard::experiments
