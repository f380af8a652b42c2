// The course of one trial as SVG elements to draw on a plan of its terrain.
#pragma once

#include <cstddef>
#include <string>

#include "truth/trace.h"

namespace rockyard::report {

// World coordinates, m.
struct DrawnArea {
  double x_min_m = 0.0;
  double x_max_m = 0.0;
  double y_min_m = 0.0;
  double y_max_m = 0.0;
};

struct TraceDrawing {
  std::string elements;  // x as in the world, y downwards (minus world y), 1 unit = 1 m
  DrawnArea area;        // what they and the plan take
};

// Most points of one drawn path.
inline constexpr std::size_t kMaxDrawnPoints = 2000;

// In the manner of Matthies 1995 fig. 16: true path solid, dead-reckoned path dotted, filled
// circles on both where hazards were believed; beyond it orange crosses at scrapes, arrow heads at
// both ends of the drive, and below the plan (`plan`) a scale, a key and a title. Paths are
// interrupted where operators reflected the rover. Marks within 2 cm of the one before are left
// out, and paths are thinned to kMaxDrawnPoints.
TraceDrawing DrawTrace(const truth::TracedTrial& trial, const DrawnArea& plan);

}  // namespace rockyard::report
