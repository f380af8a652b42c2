#include "trial/lander_place.h"

#include "trial/goal_designation.h"

namespace rockyard::trial {

sensing::LanderPlace LanderPlaceOf(const CourseParams& course, core::TrialKey key) {
  const messages::Goal place = course.LanderPlace();
  return {
      .x_m = place.x_m, .y_m = place.y_m, .pan_error_rad = PanError_rad(course.designation, key)};
}

}  // namespace rockyard::trial
