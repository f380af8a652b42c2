// A* over arcs of constant curvature (Ghosh 2018, section IV-B): the cost is the way, the heuristic
// the distance to the goal, and an arc may be driven where each of its poses may be stood at.
#pragma once

#include <cstdint>
#include <functional>

#include "experiments/arc_planning/arc_planning_params.h"
#include "math/pose.h"
#include "messages/estimates.h"

namespace rockyard::experiments {

struct ArcSearch {
  bool found = false;
  double path_m = 0.0;      // where found
  std::int64_t nodes = 0;   // expanded
  std::int64_t checks = 0;  // poses that were asked for
};

// Searches from `start` to within the goal tolerance. Nodes in one bin are one, the first that is
// expanded. Ties go to the node that was opened first.
ArcSearch SearchArcs(const ArcPlanningParams& params, const math::Pose2& start,
                     const messages::Goal& goal,
                     const std::function<bool(const math::Pose2&)>& may_stand);

}  // namespace rockyard::experiments
