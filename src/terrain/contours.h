// Lines of equal height, for maps: drawings of fields, reports. No record depends on them.
#pragma once

#include <vector>

#include "terrain/arena.h"
#include "terrain/course.h"
#include "terrain/ground.h"

namespace rockyard::terrain {

// A line of one height, open or closed, then with its first point once more at the end.
struct Contour {
  double height_m = 0.0;
  std::vector<CoursePoint> line;
};

// Contours of an area and what lies between two heights.
struct ContourMap {
  double interval_m = 0.0;
  std::vector<Contour> lines;  // by height, ascending
};

// Returns the contours of the ground, rocks apart, at whole multiples of an interval of 1, 2 or 5
// times a power of ten: the smallest that gives no more than `most` heights. They are those of
// straight lines between the heights of a grid of about `cells` squares (marching squares). Returns
// none where the ground is level. Cost: a height and a cell each.
ContourMap Contours(const Ground& ground, const Rectangle& area, int most, int cells);

}  // namespace rockyard::terrain
