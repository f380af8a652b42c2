// Where a decision of a map-based navigator was taken: course and rocks as they truly are, the
// paths so far, and the camera that looks ahead; and panels that draw them, for
// navigation_drawing.h. W is the world, R the rover; m. No record depends on what is drawn, which
// may change.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "math/pose.h"
#include "messages/estimates.h"
#include "messages/navigation_view.h"
#include "report/pinhole_camera.h"
#include "report/trace_view.h"
#include "report/xml_text.h"

namespace rockyard::report {

struct SceneRock {
  std::vector<math::Vector3> outline_W;  // as it is drawn from above
  std::vector<math::Vector3> surface_W;  // convex, above the ground
  // The rock's height over that of an obstacle, at most 1.
  double height_share = 1.0;
};

struct StepScene {
  math::Transform X_WR = math::Transform::Identity();  // true
  math::Pose2 believed;                                // in W
  double rover_length_m = 0.0;
  double rover_width_m = 0.0;
  math::Pose2 start;
  std::vector<messages::Goal> waypoints;  // true, in the order of driving
  messages::Goal goal;                    // true
  double goal_radius_m = 0.0;
  std::vector<SceneRock> rocks;
  TracePath true_path;
  TracePath believed_path;
  std::optional<PinholeCamera> camera;  // in R; none where the rover has no cameras
};

// Height of the panel's key below the frame, px.
inline constexpr double kCourseKeyHeight = 20.0;

// Returns SVG elements with the first part of figure 3 of Goldberg 2002, the course with the path
// so far, seen from above, x to the right and y up: rocks to scale (darker the higher; none that
// would be a dot), start, waypoints, goal with its radius, the true path, the path that the rover
// believed, the outline of the rover, the window of its map where the rover believes it to be, a
// scale, and a key below.
std::string CoursePanel(const StepScene& scene, const messages::NavigationView& view,
                        const SvgFrame& frame);

// Returns SVG elements with the second part of figure 3 of Goldberg 2002, the rover's view ahead
// with its grid superimposed: what the camera looks at as a line drawing, ground below the horizon,
// silhouettes of rocks (none that would be a dot), and the cells of the map that hold points, at
// their elevations, filled with the colour of their goodness (RampColour) where they have one. What
// is nearer covers what is farther. Rocks stand where they truly are; the grid lies where the rover
// believes it, from its own pose and attitude. The panel says so where the rover has no camera.
std::string CameraPanel(const StepScene& scene, const messages::NavigationView& view,
                        const SvgFrame& frame);

}  // namespace rockyard::report
