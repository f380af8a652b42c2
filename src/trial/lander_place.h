// Where the lander stands that the course tells of.
#pragma once

#include "core/random.h"
#include "sensing/aids.h"
#include "trial/course_params.h"

namespace rockyard::trial {

// By course.designation, about the line from start to goal. The pan error is that of the trial
// where goals are designated with it and 0 where they are not.
sensing::LanderPlace LanderPlaceOf(const CourseParams& course, core::TrialKey key);

}  // namespace rockyard::trial
