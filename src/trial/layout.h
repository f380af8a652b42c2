// Which terrain a trial drives on: the same for the drive and for whoever wants to look at it.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "scenario/scenario.h"
#include "terrain/course.h"

namespace rockyard::trial {

// The key of the rock field: trials that share a layout share it.
inline core::TrialKey LayoutKey(const scenario::Scenario& scenario, core::TrialKey key) {
  const auto group = static_cast<std::uint32_t>(scenario.course.trials_per_layout);
  return {key.seed, key.trial / group};
}

inline terrain::Course TerrainCourse(const CourseParams& course) {
  return {course.start_x_m, course.start_y_m, course.goal_x_m, course.goal_y_m};
}

}  // namespace rockyard::trial
