// The course of one trial: to read, as a table, drawn on a plan of its terrain, and as paths; and
// in what way two records differ. `rockyard trace`, traces of campaigns, replays and the report
// page take it from here. RecordDifferences must compare bits: a drive that does not repeat its
// stored record gets no trace (campaign_traces.cc).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "math/pose.h"
#include "truth/record.h"
#include "truth/trace.h"

namespace rockyard::report {

// Returns the last sample at or before `time_s`: what the rover believed when an event happened.
// Null where there is none. Samples are in the order of time.
const truth::TraceSample* SampleAt(std::span<const truth::TraceSample> samples, double time_s);

// Returns the columns that differ, as "name: stored 1.5, now 1.25"; none where outcome, detail and
// the bits of every value are equal (undefined values count as equal).
std::vector<std::string> RecordDifferences(const truth::RecordSchema& schema,
                                           const truth::Record& stored, const truth::Record& now);

// Samples and events in the order of time, one a line; world frame, m, s, rad:
//   row                    "sample" (every control tick) or "event"
//   time_s                 simulated time
//   kind                   of a sample what the rover does: drive, turn, steer;
//                          of an event what happened: hazard, look, vision, chosen, felt,
//                          scrape, slip, tracker, waypoint, reflection, end
//   true_x_m, true_y_m, true_heading_rad
//   tilt_rad               of the chassis
//   believed_x_m, believed_y_m, believed_heading_rad
//   odometer_m             distance by dead reckoning
//   detail                 of an event, e.g. the stripes that see a hazard ('#'), left to right;
//                          why the trial ended
// What an event line says beyond its own true pose is that of the sample before it, empty where
// there is none.
std::string TraceCsv(const truth::Trace& trace);

enum class StoryLength {
  kFolded,  // at most kMaxStoryLines lines
  kAll,     // every event on a line of its own
};

inline constexpr int kMaxStoryLines = 60;

// Outcome and detail, key figures of the record, then the events in the order of time: time, true
// pose, believed pose, believed distance to the goal, kind and detail, and how the rover turned and
// drove until the next line. Lengths in m, angles in degrees. Folded, events that follow each other
// within a short drive share a line, e.g. "12 hazard scans ..#.. to .#..., turned right 141 deg";
// the drive is the shortest one that keeps the limit. Lines have up to some 170 columns.
std::string TraceStory(const truth::TracedTrial& trial, StoryLength length);

// World coordinates, m.
struct DrawnArea {
  double x_min_m = 0.0;
  double x_max_m = 0.0;
  double y_min_m = 0.0;
  double y_max_m = 0.0;
};

struct TraceDrawing {
  std::string elements;  // x as in the world, y downwards (minus world y), 1 unit = 1 m
  DrawnArea area;        // what the elements and the plan take
};

// Most points of one drawn path.
inline constexpr std::size_t kMaxDrawnPoints = 2000;

// Draws a trial in the manner of Matthies 1995 fig. 16: true path solid, dead-reckoned path dotted,
// filled circles on both where hazards were believed; beyond it orange crosses at scrapes, arrow
// heads at both ends of the drive, and below the plan (`plan`) a scale, a key and a title. Paths
// are interrupted where operators reflected the rover. Marks within 2 cm of the one before are left
// out, and paths are thinned to kMaxDrawnPoints.
TraceDrawing DrawTrace(const truth::TracedTrial& trial, const DrawnArea& plan);

// Paths of a trace as lines to draw, in the world frame, m.
using PathPiece = std::vector<math::Pose2>;  // of a path, without interruption
using TracePath = std::vector<PathPiece>;    // interrupted where operators reflected the rover

math::Pose2 BelievedPose(const truth::TraceSample& sample);

// Both hold every sample of the trace.
TracePath TruePath(const truth::Trace& trace);
TracePath BelievedPath(const truth::Trace& trace);

// Returns the distance between the two places.
double Apart_m(const math::Pose2& a, const math::Pose2& b);

// Leaves out points that are nearer than a spacing to the last one kept: the least of 5 mm and its
// multiples by 1.5 that leaves at most that many points, and not much more than 10 m, whatever is
// then left. Both ends of every piece stay.
TracePath Thinned(const TracePath& path, std::size_t most_points);

// Leaves out points as long as none that is left out is further than the tolerance from the line
// that is drawn without it (Douglas and Peucker 1973); both ends of every piece stay.
TracePath Simplified(const TracePath& path, double tolerance_m);

}  // namespace rockyard::report
