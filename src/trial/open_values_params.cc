#include "trial/open_values_params.h"

#include <algorithm>

#include "math/functions.h"

namespace rockyard::trial {
namespace {

// Way without progress, over the course; progress, over the width of the rover.
constexpr double kDistanceShare = 0.5;
constexpr double kProgressShare = 0.5;
// The proportions of the defaults of RefereeParams: an hour for 4 m, four hours for 7.6 m.
constexpr double kTimePerDistance_s_m = 900.0;
constexpr double kTimePerCourse_s_m = 14400.0 / 7.6;

double AtLeast(double limit, double wanted) { return limit > 0.0 ? std::max(limit, wanted) : 0.0; }

}  // namespace

double CourseLength_m(const CourseParams& course) {
  double length_m = 0.0;
  messages::Goal from{course.start_x_m, course.start_y_m};
  for (const messages::Goal& to : course.Goals()) {
    length_m += math::Hypot(to.x_m - from.x_m, to.y_m - from.y_m);
    from = to;
  }
  return length_m;
}

RefereeParams PatienceFor(const DriveParams& drive) {
  RefereeParams referee = drive.referee;
  const double course_m = CourseLength_m(drive.course);
  const double distance_m = kDistanceShare * course_m;
  referee.no_path_progress_m =
      AtLeast(referee.no_path_progress_m, kProgressShare * drive.rover.geometry.width_m);
  referee.no_path_distance_m = AtLeast(referee.no_path_distance_m, distance_m);
  referee.no_path_time_s = AtLeast(referee.no_path_time_s, kTimePerDistance_s_m * distance_m);
  referee.time_limit_s = AtLeast(referee.time_limit_s, kTimePerCourse_s_m * course_m);
  return referee;
}

}  // namespace rockyard::trial
