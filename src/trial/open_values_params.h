// Values that a scenario may leave open: they follow others unless it states them.
#pragma once

#include <array>
#include <string_view>

#include "trial/clock/compute_params.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// Length of the course: straight from the start by its waypoints to the goal, m.
double CourseLength_m(const CourseParams& course);

// What each limit that may be left open is where it is: that of `drive.referee`, which is meant for
// the 7.6 m of Matthies 1995 and a rover half a metre wide, or more on a longer course with a
// larger rover, in the proportions of there. A limit of 0 (none) stays none. Assumed, as they are.
RefereeParams PatienceFor(const DriveParams& drive);

// A value that is null or absent in a scenario. It is set once, when the file is read, and stands
// as a number in the resolved scenario, so that a law that changes leaves stored runs as they were.
struct OpenValue {
  std::string_view path;                       // in a scenario
  double& (*in)(DriveParams& drive);           // where it is kept
  double (*suited)(const DriveParams& drive);  // to the rest of the drive
};

// A limit of the referee, which follows course and rover.
template <double RefereeParams::*kLimit>
constexpr OpenValue OpenLimit(std::string_view path) {
  return {path, [](DriveParams& drive) -> double& { return drive.referee.*kLimit; },
          [](const DriveParams& drive) { return PatienceFor(drive).*kLimit; }};
}

inline constexpr std::array<OpenValue, 5> kOpenValues = {
    OpenLimit<&RefereeParams::no_path_progress_m>("referee.no_path_progress_m"),
    OpenLimit<&RefereeParams::no_path_distance_m>("referee.no_path_distance_m"),
    OpenLimit<&RefereeParams::no_path_time_s>("referee.no_path_time_s"),
    OpenLimit<&RefereeParams::time_limit_s>("referee.time_limit_s"),
    OpenValue{"clock.compute.acquisition_s",
              [](DriveParams& drive) -> double& { return drive.clock.compute.acquisition_s; },
              [](const DriveParams& drive) { return drive.clock.compute.SuitedAcquisition_s(); }},
};

}  // namespace rockyard::trial
