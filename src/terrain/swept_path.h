// Where a rover that drives straight along x first touches a rock.
#pragma once

#include <optional>

#include "terrain/rock.h"

namespace rockyard::terrain {

// Returns the smallest x of the part of the rock's outline (the ellipse of its horizontal axes)
// that lies within half_width_m of the line y = y_m; none where no part does. The front of the
// rover is taken as a straight edge of that half width.
std::optional<double> FirstContact(const Rock& rock, double y_m, double half_width_m);

}  // namespace rockyard::terrain
