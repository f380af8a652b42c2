// The goal that a rover is told, as an operator designates it in the lander's stereo images.
#pragma once

#include "core/random.h"
#include "messages/estimates.h"
#include "trial/course_params.h"
#include "trial/designation_params.h"

namespace rockyard::trial {

// True goal plus downrange and crossrange error, seen from the lander's cameras; the true goal
// where designation is off or the lander stands on it. Randomness: Purpose::kGoalDesignation,
// always three numbers (crossrange, downrange, pan), so that changing one error shifts no other.
// Cost: below 1 us.
messages::Goal DesignatedGoal(const CourseParams& course, core::TrialKey key);

}  // namespace rockyard::trial
