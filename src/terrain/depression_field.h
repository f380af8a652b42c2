// Ditches and pits as a height field.
#pragma once

#include <vector>

#include "terrain/depression_params.h"
#include "terrain/relief.h"

namespace rockyard::terrain {

// At the distance r from its segment a depression of depth D, half width R and flank e is
//   D          where r <= R - e: the floor,
//   D (1 - S)  with s = (r - R + e) / e and S = s^3 (10 - 15 s + 6 s^2) on the flank,
//   0          where r >= R
// deep: twice continuously differentiable, without libm. Where several overlap the deepest counts,
// so that a ditch across another is no deeper than either; only there the slope can jump, over a
// ridge.
class DepressionField {
 public:
  explicit DepressionField(const std::vector<Depression>& depressions);

  // Returns height, 0 or less, and slopes at a point. Cost: 1 to 3 ns for each depression.
  ReliefSample Sample(double x_m, double y_m) const;

  // Returns whether any depression reaches into the disc around (x, y).
  bool Reaches(double x_m, double y_m, double radius_m) const;

  // These are the largest magnitudes of the slope and of the second derivative in any direction,
  // 1/m, of any of the depressions: 15/8 D/e and 10/sqrt(3) D/e^2. Across a ridge between two the
  // slope falls at once, which a ray from above meets no sooner.
  double MaxSlope() const { return max_slope_; }
  double MaxCurvature() const { return max_curvature_per_m_; }

 private:
  // A depression with its direction as a unit vector.
  struct Shape {
    double x_m, y_m, along_x, along_y;
    double half_length_m, half_width_m, flank_m, depth_m;
  };

  // A point in the frame of the segment: how far beyond its end, with the sign of the end, and how
  // far across.
  struct Place {
    double beyond_m, across_m;
  };
  static Place PlaceOf(const Shape& shape, double x_m, double y_m);
  static ReliefSample SampleOf(const Shape& shape, double x_m, double y_m);

  std::vector<Shape> shapes_;
  double max_slope_ = 0.0;
  double max_curvature_per_m_ = 0.0;
};

}  // namespace rockyard::terrain
