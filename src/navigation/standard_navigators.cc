#include "navigation/gestalt/gestalt.h"
#include "navigation/pathfinder/pathfinder.h"
#include "navigation/route_follower.h"
#include "navigation/standard_navigators_params.h"

namespace rockyard::navigation {

NavigatorSet StandardNavigators() {
  NavigatorSet set;
  set.Add(DescribePathfinder());
  set.Add(DescribeGestalt());
  set.Add(DescribeRouteFollower());
  return set;
}

}  // namespace rockyard::navigation
