// The paths of a trace as lines to draw. World frame, m.
#pragma once

#include <cstddef>
#include <vector>

#include "math/pose.h"
#include "truth/trace.h"

namespace rockyard::report {

using PathPiece = std::vector<math::Pose2>;  // of a path, without interruption
using TracePath = std::vector<PathPiece>;    // interrupted where operators reflected the rover

math::Pose2 BelievedPose(const truth::TraceSample& sample);

// Both hold every sample of the trace.
TracePath TruePath(const truth::Trace& trace);
TracePath BelievedPath(const truth::Trace& trace);

// Returns the distance between the two places.
double Apart_m(const math::Pose2& a, const math::Pose2& b);

// Leaves out points that are nearer to the one before than 5 mm, or than what leaves at most that
// many points (with 10 m, what then is left); both ends of every piece stay.
TracePath Thinned(const TracePath& path, std::size_t most_points);

// Leaves out points as long as no left one is further than the tolerance from the line that is
// drawn without it (Douglas and Peucker 1973); both ends of every piece stay.
TracePath Simplified(const TracePath& path, double tolerance_m);

}  // namespace rockyard::report
