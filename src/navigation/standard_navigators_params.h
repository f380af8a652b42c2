// The navigators that every scenario can name.
#pragma once

#include "navigation/navigator_set_params.h"

namespace rockyard::navigation {

// The one list of them: pathfinder (chosen), gestalt, route.
NavigatorSet StandardNavigators();

}  // namespace rockyard::navigation
