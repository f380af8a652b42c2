// Everything that one drive needs to know: the parameters of every module below, and trial's own.
#pragma once

#include "core/fields.h"
#include "rover/rover_params.h"
#include "terrain/terrain_params.h"
#include "trial/clock_params.h"
#include "trial/course_params.h"
#include "trial/energy_params.h"
#include "trial/referee_params.h"
#include "trial/suite_params.h"

namespace rockyard::trial {

struct DriveParams {
  terrain::TerrainParams terrain;
  rover::RoverParams rover;
  SensorParams sensors;
  PerceptionParams perception;
  LocalizationParams localization;
  NavigationParams navigation;
  CourseParams course;
  RefereeParams referee;
  ClockParams clock;
  EnergyParams energy;

  // Lists its groups in the group that is being visited: it has no name of its own in a file. What
  // holds across them is required by drive_consistency_params.h and drive_checks_params.h, which
  // ask for more or less by what the experiment does with the drive.
  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::trial
