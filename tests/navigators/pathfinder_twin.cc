// rockyard's own behaviour controller as a plugin: the same sources, so that a drive with it is the
// drive of the built-in one, bit for bit.
#include "navigation/pathfinder/pathfinder.h"
#include "plugin/navigator_plugin.h"

namespace {

rockyard::navigation::NavigatorDescription<rockyard::navigation::PathfinderParams> DescribeTwin() {
  auto description = rockyard::navigation::DescribePathfinder();
  description.name = "pathfinder_twin";
  return description;
}

}  // namespace

ROCKYARD_NAVIGATORS(DescribeTwin)
