#include "terrain/depression_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rockyard::terrain {

DepressionField::DepressionField(const std::vector<Depression>& depressions) {
  for (const Depression& one : depressions) {
    shapes_.push_back({one.x_m, one.y_m, std::cos(one.direction_rad), std::sin(one.direction_rad),
                       one.half_length_m, one.half_width_m, one.flank_m, one.depth_m});
    // S' = 30 s^2 (1 - s)^2 is at most 15/8, |S''| = 60 s (1 - s) |1 - 2 s| at most 10/sqrt(3).
    // Around a round end the slope over the distance, at most 40/9 D/e^2, is less.
    max_slope_ = std::max(max_slope_, 1.875 * one.depth_m / one.flank_m);
    max_curvature_per_m_ =
        std::max(max_curvature_per_m_,
                 10.0 * std::numbers::inv_sqrt3 * one.depth_m / (one.flank_m * one.flank_m));
  }
}

DepressionField::Place DepressionField::PlaceOf(const Shape& shape, double x_m, double y_m) {
  const double dx_m = x_m - shape.x_m;
  const double dy_m = y_m - shape.y_m;
  const double along_m = shape.along_x * dx_m + shape.along_y * dy_m;
  return {std::copysign(std::max(std::abs(along_m) - shape.half_length_m, 0.0), along_m),
          shape.along_x * dy_m - shape.along_y * dx_m};
}

ReliefSample DepressionField::SampleOf(const Shape& shape, double x_m, double y_m) {
  const auto [beyond_m, across_m] = PlaceOf(shape, x_m, y_m);
  // Most points are beside most depressions.
  if (!(std::abs(across_m) < shape.half_width_m)) return {};
  const double r_m = std::sqrt(beyond_m * beyond_m + across_m * across_m);
  if (!(r_m < shape.half_width_m)) return {};
  const double s = (r_m - shape.half_width_m + shape.flank_m) / shape.flank_m;
  if (s <= 0.0) return {-shape.depth_m, 0.0, 0.0};
  const double rest = 1.0 - s;
  const double height_m = -shape.depth_m * (1.0 - s * s * s * (10.0 + s * (6.0 * s - 15.0)));
  // Rises along the gradient of r: (beyond, across) / r in the frame of the segment.
  const double rise = shape.depth_m * 30.0 * s * s * rest * rest / shape.flank_m / r_m;
  const double rise_along = rise * beyond_m;
  const double rise_across = rise * across_m;
  return {height_m, rise_along * shape.along_x - rise_across * shape.along_y,
          rise_along * shape.along_y + rise_across * shape.along_x};
}

bool DepressionField::Reaches(double x_m, double y_m, double radius_m) const {
  return std::any_of(shapes_.begin(), shapes_.end(), [&](const Shape& shape) {
    const Place place = PlaceOf(shape, x_m, y_m);
    const double reach_m = shape.half_width_m + radius_m;
    return place.beyond_m * place.beyond_m + place.across_m * place.across_m < reach_m * reach_m;
  });
}

ReliefSample DepressionField::Sample(double x_m, double y_m) const {
  ReliefSample deepest;
  for (const Shape& shape : shapes_) {
    const ReliefSample sample = SampleOf(shape, x_m, y_m);
    if (sample.height_m < deepest.height_m) deepest = sample;
  }
  return deepest;
}

}  // namespace rockyard::terrain
