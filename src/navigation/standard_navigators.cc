#include "navigation/enav/enav.h"
#include "navigation/gestalt/gestalt.h"
#include "navigation/navigator_set_params.h"
#include "navigation/pathfinder/pathfinder.h"
#include "navigation/route_follower.h"

namespace rockyard::navigation {

NavigatorSet StandardNavigators() {
  NavigatorSet set;
  // Must stay in this order: the first is the default, resolved scenarios list the groups so, and
  // fingerprints hash their text.
  set.Add(DescribePathfinder());
  set.Add(DescribeGestalt());
  set.Add(DescribeRouteFollower());
  set.Add(DescribeEnav());
  return set;
}

}  // namespace rockyard::navigation
