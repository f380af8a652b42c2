// Which terrain a trial drives on. Drives, studies, replays and the command `terrain` all build it
// by these two functions, so that they see the same terrain. Records depend on it: rocks and relief
// are drawn by LayoutKey, whose trial is the column `layout`.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "terrain/course.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// Returns the key of a trial's rock field. Trials of one layout share it, so that their results are
// not independent, which confidence intervals reckon with; noise and start stay those of the trial.
inline core::TrialKey LayoutKey(const DriveParams& drive, core::TrialKey key) {
  const auto group = static_cast<std::uint32_t>(drive.course.trials_per_layout);
  return {key.seed, key.trial / group};
}

// Returns the places that the terrain keeps free of rocks, and the rock at the goal.
inline terrain::Course TerrainCourse(const CourseParams& course) {
  terrain::Course points{
      course.start_x_m, course.start_y_m, course.goal_x_m, course.goal_y_m, {}, {}};
  if (course.goal_rock.enabled) {
    points.goal_rock = {course.goal_rock.diameter_m, course.goal_rock.height_m};
  }
  for (const messages::Goal& place : course.waypoints.Places()) {
    points.waypoints.push_back({place.x_m, place.y_m});
  }
  return points;
}

}  // namespace rockyard::trial
