// Pixels that stick out of those around them.
#pragma once

#include <cstdint>

#include "vision/odometry/feature.h"
#include "vision/odometry/harris.h"

namespace rockyard::vision {

// Pixels of `area` whose response to the weight is at least `threshold`, larger than that of the
// pixels within `reach` columns and rows that come before them in the order of rows, and not
// smaller than that of those that come after; in the order of rows. Pixels that `sums` lacks do not
// count: it has those of the area, and, where the answer is to be that of the whole image, those
// around it, which the image has. Cost: below 1 ns a pixel with 64 bytes a vector and a reach of 3.
Features LocalMaxima(const GradientSums& sums, std::int32_t weight, const ImageArea& area,
                     int reach, std::int32_t threshold);

}  // namespace rockyard::vision
