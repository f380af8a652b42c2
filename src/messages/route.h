// A way that somebody else worked out for the rover.
#pragma once

#include <vector>

#include "messages/estimates.h"

namespace rockyard::messages {

// Corners of a way in the world frame, the first one to drive to first; the last one is the goal.
// Empty: there is no way.
struct Route {
  std::vector<Goal> corners;
};

}  // namespace rockyard::messages
