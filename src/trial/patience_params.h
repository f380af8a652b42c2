// How long an operator bears with a rover, where a scenario leaves that open.
#pragma once

#include <array>
#include <string_view>

#include "trial/drive_params.h"

namespace rockyard::trial {

// A limit of the referee that follows course and rover unless a scenario states it.
struct OpenLimit {
  std::string_view path;  // in a scenario
  double RefereeParams::*value;
};

inline constexpr std::array<OpenLimit, 4> kOpenLimits = {{
    {"referee.no_path_progress_m", &RefereeParams::no_path_progress_m},
    {"referee.no_path_distance_m", &RefereeParams::no_path_distance_m},
    {"referee.no_path_time_s", &RefereeParams::no_path_time_s},
    {"referee.time_limit_s", &RefereeParams::time_limit_s},
}};

// Length of the course: straight from the start by its waypoints to the goal, m.
double CourseLength_m(const CourseParams& course);

// What each limit of kOpenLimits is where it is left open: that of `drive.referee`, which is meant
// for the 7.6 m of Matthies 1995 and a rover half a metre wide, or more on a longer course with a
// larger rover, in the proportions of there. A limit of 0 (none) stays none. Assumed, as they are.
RefereeParams PatienceFor(const DriveParams& drive);

}  // namespace rockyard::trial
