// A drive whose course can be told by hand: 1 m east, a turn of 30 deg to the right in three scans,
// a scrape, 0.5 m south by hand of the operators, the end.
#pragma once

#include "truth/trace.h"

namespace rockyard::report {

inline truth::TraceSample SampleOf(double time_s, double x_m, double y_m, double heading_rad,
                                   const char* activity) {
  return {time_s, {x_m, y_m, heading_rad}, 0.1, {x_m + 0.5, y_m, heading_rad, x_m}, activity};
}

inline truth::TracedTrial SampleTrial() {
  truth::TracedTrial trial;
  trial.scenario = "sample<&>";
  trial.seed = 7;
  trial.goal = {3.5, 0.0};
  trial.schema = {{"true_distance_m", "m", ""}, {"scans", "1", ""}};
  trial.record = {12, truth::TrialOutcome::kNoPath, "nowhere to go", {2.0, 9.0}};
  truth::Trace& trace = trial.trace;
  for (int i = 0; i <= 10; ++i) {
    trace.samples.push_back(SampleOf(i, 0.1 * i, 0.0, 0.0, "drive"));
  }
  for (int i = 1; i <= 3; ++i) {
    const double heading_rad = -i * math::DegToRad(10.0);
    trace.events.push_back({20.0 * i, {1.0, 0.0, 0.0}, "hazard", i < 3 ? "..#.." : "#...."});
    trace.samples.push_back(SampleOf(20.0 * i + 1, 1.0, 0.0, heading_rad, "turn"));
  }
  trace.events.push_back({61.0, {1.0, 0.0, -0.5}, "reflection", ""});
  for (int i = 0; i <= 5; ++i) {
    trace.samples.push_back(SampleOf(62.0 + i, 1.0 + 0.1 * i, -0.5, 0.0, "drive"));
  }
  trace.events.push_back({67.0, {1.5, -0.5, 0.0}, "scrape", ""});
  trace.events.push_back({67.0, {1.5, -0.5, 0.0}, "end", "nowhere to go"});
  return trial;
}

}  // namespace rockyard::report
