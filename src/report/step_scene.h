// Where a decision of a map-based navigator was taken: course and rocks as they truly are, the
// paths so far, and the camera that looks ahead. W is the world, R the rover; m.
#pragma once

#include <optional>
#include <vector>

#include "math/pose.h"
#include "messages/estimates.h"
#include "report/pinhole_camera.h"
#include "report/trace_path.h"

namespace rockyard::report {

struct SceneRock {
  std::vector<math::Vector3> outline_W;  // as it is drawn from above
  std::vector<math::Vector3> surface_W;  // convex, above the ground
  // Of its height in that of an obstacle, at most 1.
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

}  // namespace rockyard::report
