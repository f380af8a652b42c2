// The course of one trial over time, recorded on request; a trial is the same with a trace and
// without, and no store or hash holds one. The tracer of a drive writes it; replays, drawings and
// files of traces read it. Must stay: the texts of activities and kinds of events, by which readers
// tell them apart.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "math/pose.h"
#include "messages/estimates.h"
#include "messages/wheels.h"
#include "truth/record.h"

namespace rockyard::truth {

// How the rover stands: true pose and every joint, as in truth::RoverState.
struct RoverPosture {
  math::Transform X_WR = math::Transform::Identity();
  double left_rocker_rad = 0.0;
  double right_rocker_rad = 0.0;
  double left_bogie_rad = 0.0;
  double right_bogie_rad = 0.0;
  messages::PerWheel<double> steer_rad{};
  messages::PerWheel<double> wheel_angle_rad{};
};

// The rover at one moment.
struct TraceSample {
  double time_s = 0.0;
  math::Pose2 pose;  // true
  double tilt_rad = 0.0;
  messages::PoseEstimate estimate;
  // Of the stretch that ends here: "drive", "turn" or "steer" at a control tick; those of
  // TraceRest.
  std::string activity;
  RoverPosture posture{};
};

// A moment between two control ticks: the start, the end of a stretch at rest (activity "scan",
// "image", "compute", "overhead" or "stall"), the moment after operators set the rover back, or the
// end. The activity of start, end and setting back is empty.
struct TraceRest {
  std::size_t samples_before = 0;  // how many samples the trace has up to this moment
  bool set_back = false;           // by operators: the rover stands elsewhere than a moment before
  TraceSample sample;
};

// Something that happened at a moment, for people to read.
struct TraceEvent {
  double time_s = 0.0;
  math::Pose2 pose;  // true, when it happened
  // "hazard", "look", "chosen", "felt", "scrape", "reflection", "waypoint", "tracker", "vision",
  // "slip", "overlay", "end".
  std::string kind;
  std::string detail;
};

// A rock that the rover has pushed to another place.
struct RockMove {
  double time_s = 0.0;
  int rock = 0;  // index in Terrain::rocks()
  math::Vector3 center_W = math::Vector3::Zero();
};

// The course of one trial; each list in the order of time.
struct Trace {
  std::vector<TraceSample> samples;  // of every control tick
  std::vector<TraceRest> rests;
  std::vector<TraceEvent> events;
  std::vector<RockMove> rock_moves;

  // Returns the time of the last sample or rest, s.
  double now_s() const {
    const double at_rest_s = rests.empty() ? 0.0 : rests.back().sample.time_s;
    return samples.empty() ? at_rest_s : std::max(at_rest_s, samples.back().time_s);
  }
};

// A trial with its course, as replays and traces of campaigns take it.
struct TracedTrial {
  std::string scenario;
  std::uint64_t seed = 1;
  messages::Goal goal;
  RecordSchema schema;
  Record record;
  Trace trace;
};

}  // namespace rockyard::truth
