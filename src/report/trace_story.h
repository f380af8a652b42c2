// What happened in one trial, to read.
#pragma once

#include <string>

#include "truth/trace.h"

namespace rockyard::report {

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
