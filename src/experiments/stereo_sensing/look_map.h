// What the scenario's navigator makes of the points of one look.
#pragma once

#include "messages/navigation_view.h"
#include "messages/point_cloud.h"
#include "navigation/navigator_set_params.h"

namespace rockyard::experiments {

// Returns the map of a navigator that begins to drive, level and at the origin of the map's frame,
// and gets `cloud` as its first look: coordinates of the map are those of R. A look behind, if it
// asks for one, shows nothing. Throws std::runtime_error where the navigator keeps no map.
messages::MapView MapOfLook(const navigation::NavigatorKind& navigator,
                            const messages::PointCloud& cloud);

// What a map says of one place.
enum class Verdict { kUnknown, kClear, kHazard };

// Cells of `hazard_goodness` or less are hazards; outside the map all is unknown.
Verdict VerdictAt(const messages::MapView& map, double x_m, double y_m, double hazard_goodness);

}  // namespace rockyard::experiments
