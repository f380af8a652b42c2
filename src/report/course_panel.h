// The first part of figure 3 of Goldberg 2002: the course with the path so far, seen from above.
#pragma once

#include <string>

#include "messages/navigation_view.h"
#include "report/step_scene.h"
#include "report/svg_elements.h"

namespace rockyard::report {

// Height of the panel's key below the frame, px.
inline constexpr double kCourseKeyHeight = 20.0;

// SVG elements, x to the right and y up: rocks to scale (darker the higher; none that would be a
// dot), start, waypoints, goal
// with its radius, the true path, the path that the rover believed, the outline of the rover, the
// window of its map where the rover believes it to be, a scale, and a key below.
std::string CoursePanel(const StepScene& scene, const messages::NavigationView& view,
                        const SvgFrame& frame);

}  // namespace rockyard::report
