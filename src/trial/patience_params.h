// How long an operator bears with a rover, where a scenario leaves that open.
#pragma once

#include "trial/drive_params.h"

namespace rockyard::trial {

// Length of the course: straight from the start by its waypoints to the goal, m.
double CourseLength_m(const CourseParams& course);

// What each limit that may be left open (open_values_params.h) is where it is: that of
// `drive.referee`, which is meant for the 7.6 m of Matthies 1995 and a rover half a metre wide, or
// more on a longer course with a larger rover, in the proportions of there. A limit of 0 (none)
// stays none. Assumed, as they are.
RefereeParams PatienceFor(const DriveParams& drive);

}  // namespace rockyard::trial
