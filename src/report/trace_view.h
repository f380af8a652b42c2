// What story, CSV and drawing of a trial look up in its trace, and in what way two records differ;
// the course of a trial as a table and to read.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "truth/record.h"
#include "truth/trace.h"

namespace rockyard::report {

// The last sample at or before `time_s`: what the rover believed when an event happened. Null where
// there is none. Samples are in the order of time.
const truth::TraceSample* SampleAt(std::span<const truth::TraceSample> samples, double time_s);

// The columns that differ, as "name: stored 1.5, now 1.25"; empty where outcome, detail and the
// bits of every value are equal (undefined values count as equal).
std::vector<std::string> RecordDifferences(const truth::RecordSchema& schema,
                                           const truth::Record& stored, const truth::Record& now);

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

}  // namespace rockyard::report
