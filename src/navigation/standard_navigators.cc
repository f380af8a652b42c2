#include "navigation/gestalt/gestalt.h"
#include "navigation/navigator_set_params.h"
#include "navigation/pathfinder/pathfinder.h"
#include "navigation/route_follower.h"

namespace rockyard::navigation {

NavigatorSet StandardNavigators() {
  NavigatorSet set;
  // The first is the default. Resolved scenarios list their groups in this order, and fingerprints
  // hash that text.
  set.Add(DescribePathfinder());
  set.Add(DescribeGestalt());
  set.Add(DescribeRouteFollower());
  return set;
}

}  // namespace rockyard::navigation
