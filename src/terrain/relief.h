// What a part of the ground that is no plane adds to it, and where a ray crosses it.
#pragma once

#include <cmath>

namespace rockyard::terrain {

// Height and slopes at one point.
struct ReliefSample {
  double height_m = 0.0;
  double slope_x = 0.0;  // dz/dx
  double slope_y = 0.0;  // dz/dy
};

// How a ray nears the ground at one of its points.
struct Approach {
  double gap_m;  // height above the ground
  double rate;   // closing of the gap per metre of ray
};

// Returns a zero of `gap` between `above`, where it is positive, and `below`, where it is not, to
// 1e-12 m: false position with the Illinois rule (Dowell and Jarratt 1971), which halves the value
// at an end that stays.
template <typename Gap>
double FindCrossing(const Gap& gap, double above, double gap_above, double below,
                    double gap_below) {
  // As exact as contacts and pixels will ever need.
  constexpr double kCrossingWidth_m = 1e-12;
  constexpr int kMaxCrossingSteps = 100;
  int kept_end = 0;  // -1 below, +1 above: the end that the last step left where it was
  for (int i = 0; i < kMaxCrossingSteps && below - above > kCrossingWidth_m; ++i) {
    // The secant's zero between the two ends.
    const double t = below - gap_below * (below - above) / (gap_below - gap_above);
    const double gap_t = gap(t);
    if (std::abs(gap_t) < kCrossingWidth_m) return t;
    if (gap_t > 0.0) {
      above = t;
      gap_above = gap_t;
      if (kept_end == -1) gap_below *= 0.5;
      kept_end = -1;
    } else {
      below = t;
      gap_below = gap_t;
      if (kept_end == 1) gap_above *= 0.5;
      kept_end = 1;
    }
  }
  return above;
}

}  // namespace rockyard::terrain
