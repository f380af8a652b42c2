#include "trial/lander_place.h"

#include <cmath>

#include "trial/goal_designation.h"

namespace rockyard::trial {

sensing::LanderPlace LanderPlaceOf(const CourseParams& course, core::TrialKey key) {
  const double dx = course.goal_x_m - course.start_x_m;
  const double dy = course.goal_y_m - course.start_y_m;
  const double straight_m = std::hypot(dx, dy);
  const double ahead = course.designation.lander_ahead_m / straight_m;
  const double left = course.designation.lander_left_m / straight_m;
  return {.x_m = course.start_x_m + ahead * dx - left * dy,
          .y_m = course.start_y_m + ahead * dy + left * dx,
          .pan_error_rad = PanErrorOf(course, key)};
}

}  // namespace rockyard::trial
