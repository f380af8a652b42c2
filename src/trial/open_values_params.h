// Values that a scenario may leave open: they follow from other parameters unless the scenario
// states them. Reading a scenario sets them; doubts about limits follow the same law.
#pragma once

#include <array>
#include <string_view>

#include "trial/clock/compute_params.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// Returns the length of the course, straight from the start by its waypoints to the goal, m.
double CourseLength_m(const CourseParams& course);

// Returns `drive.referee` with the limits that hold where a scenario leaves them open. They are
// those of `drive.referee`, which are meant for the 7.6 m of Matthies 1995 and a rover half a metre
// wide, or larger in proportion to a longer course and a wider rover. A limit of 0 (none) stays
// none. The proportions are assumed, as the limits are; referee_params.cc tells them in its help.
// Limits are doubted below about half of these values (campaign/scenario_doubts.cc), which must
// follow them.
RefereeParams PatienceFor(const DriveParams& drive);

// A value that a scenario may leave null or absent. Must stay: it is set once, when the file is
// read, and stands as a number in the resolved scenario, so that a law that changes leaves stored
// runs as they were.
struct OpenValue {
  std::string_view path;                       // in a scenario
  double& (*in)(DriveParams& drive);           // returns where the value is kept
  double (*suited)(const DriveParams& drive);  // returns the value that suits the rest of the drive
};

// Returns the open value of a limit of the referee, which follows course and rover.
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
