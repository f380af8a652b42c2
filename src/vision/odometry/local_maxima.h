// Pixels that stick out of those around them.
#pragma once

#include <cstdint>
#include <functional>

#include "vision/odometry/feature.h"
#include "vision/odometry/harris.h"

namespace rockyard::vision {

// Writes the responses of one row of an area, rows in order (HarrisRows, GradientSums).
using ResponseWriter = std::function<void(int row, std::int32_t* response)>;

// Pixels of `area` whose response is at least `threshold`, larger than that of the pixels within
// `reach` columns and rows that come before them in the order of rows, and not smaller than that of
// those that come after; in the order of rows. Pixels that `all` lacks do not count: it has those
// of the area, and, where the answer is to be that of the whole image, those around it, which the
// image has. `write` writes the rows of `all`. Cost: below 1 ns a pixel with 32 bytes a vector and
// a reach of 3.
Features LocalMaxima(const ResponseWriter& write, const ImageArea& all, const ImageArea& area,
                     int reach, std::int32_t threshold);

}  // namespace rockyard::vision
