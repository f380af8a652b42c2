// The course of one trial over time, recorded on request.
#pragma once

#include <string>
#include <vector>

#include "math/pose.h"
#include "messages/estimates.h"

namespace rockyard::truth {

struct TraceSample {
  double time_s = 0.0;
  math::Pose2 pose;  // true
  double tilt_rad = 0.0;
  messages::PoseEstimate estimate;
  std::string activity;  // "drive", "turn", "steer"
};

struct TraceEvent {
  double time_s = 0.0;
  math::Pose2 pose;  // true, when it happened
  std::string kind;  // "hazard", "look", "chosen", "felt", "scrape", "reflection", "end"
  std::string detail;
};

struct Trace {
  std::vector<TraceSample> samples;
  std::vector<TraceEvent> events;
};

}  // namespace rockyard::truth
