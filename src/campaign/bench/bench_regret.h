// What the ways of entries are judged by: that of a rover that sees perfectly, as far as its stereo
// cameras reach, and takes for free what it has not seen (trial/course/route_planner.h). No entry
// decides it, nor does knowledge that no navigator can have.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "batch/result_store.h"

namespace rockyard::campaign {

struct OptimisticWays {
  // By cell and layout, m. NaN where there is no way, and in cells that are no case for it: without
  // stereo cameras, with drawn rocks, waypoints, a moving goal or one that is a rock, an elevation
  // model, ditches or pits. A slope counts as level ground.
  std::vector<std::vector<double>> ways_m;
  std::string why_none;  // a sentence where the rocks of the run cannot be laid out again
};

// Returns the ways of all layouts of a run, on all processors. Nothing but the scenarios of its
// cells and their seeds decides them. Where the rocks come out as others than those of its records,
// as another build may lay them out, or a scenario cannot be read, there are none.
OptimisticWays MakeOptimisticWays(const batch::ResultStore& store);

}  // namespace rockyard::campaign
