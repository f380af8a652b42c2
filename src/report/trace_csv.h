// The course of one trial as a table.
#pragma once

#include <string>

#include "truth/trace.h"

namespace rockyard::report {

// Samples and events in the order of time, one a line; world frame, m, s, rad:
//   row                    "sample" (every control tick) or "event"
//   time_s                 simulated time
//   kind                   of a sample what the rover does: drive, turn, steer;
//                          of an event what happened: hazard, scrape, reflection, end
//   true_x_m, true_y_m, true_heading_rad
//   tilt_rad               of the chassis
//   believed_x_m, believed_y_m, believed_heading_rad
//   odometer_m             distance by dead reckoning
//   detail                 of an event: the stripes that see a hazard ('#'), left to right; why the
//                          trial ended
// What an event line says beyond its own true pose is that of the sample before it, empty where
// there is none.
std::string TraceCsv(const truth::Trace& trace);

}  // namespace rockyard::report
