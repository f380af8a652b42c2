#include "trial/goal_designation.h"

#include <cmath>

#include "core/distributions.h"

namespace rockyard::trial {
namespace {

// From the lander's cameras to the goal.
struct LineOfSight {
  double range_m = 0.0;
  double along_x = 1.0;  // unit vector
  double along_y = 0.0;
};

LineOfSight ToGoal(const CourseParams& course) {
  const double dx = course.goal_x_m - course.start_x_m;
  const double dy = course.goal_y_m - course.start_y_m;
  const double straight_m = std::hypot(dx, dy);
  const double ahead = course.designation.lander_ahead_m / straight_m;
  const double left = course.designation.lander_left_m / straight_m;
  const double sight_x_m = dx - ahead * dx + left * dy;
  const double sight_y_m = dy - ahead * dy - left * dx;
  const double range_m = std::hypot(sight_x_m, sight_y_m);
  if (range_m <= 0.0) return {};
  return {range_m, sight_x_m / range_m, sight_y_m / range_m};
}

}  // namespace

messages::Goal DesignatedGoal(const CourseParams& course, core::TrialKey key) {
  const messages::Goal truth{course.goal_x_m, course.goal_y_m};
  if (!course.designation.enabled) return truth;
  const LineOfSight sight = ToGoal(course);
  const DesignationErrors errors = course.designation.ErrorsAt(sight.range_m);
  core::RandomStream stream(key, core::Purpose::kGoalDesignation);
  const double crossrange_m = core::SampleNormal(stream, 0.0, errors.crossrange_sd_m);
  const double downrange_m = core::SampleNormal(stream, 0.0, errors.downrange_sd_m);
  const double uniform = core::SampleUniform(stream, -1.0, 1.0);
  const double pan = course.designation.pan_kind == PanError::kFixed ? 1.0 : uniform;
  const double left_m = crossrange_m + pan * errors.crossrange_bias_m;
  return {truth.x_m + downrange_m * sight.along_x - left_m * sight.along_y,
          truth.y_m + downrange_m * sight.along_y + left_m * sight.along_x};
}

}  // namespace rockyard::trial
