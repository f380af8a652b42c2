// Start, waypoints and goal of a trial, as far as a terrain needs to know them: clear zones lie
// around them, and a goal rock at the goal. The trial makes it of its course.
#pragma once

#include <vector>

namespace rockyard::terrain {

// A round rock with the profile of the field's rocks; a diameter of 0 means no rock.
struct CourseRock {
  double diameter_m = 0.0;
  double height_m = 0.0;  // above the ground
};

// A place of the course, in W.
struct CoursePoint {
  double x_m = 0.0;
  double y_m = 0.0;
};

// The points are in W, m.
struct Course {
  double start_x_m = 0.0;
  double start_y_m = 0.0;
  double goal_x_m = 7.6;
  double goal_y_m = 0.0;
  std::vector<CoursePoint> waypoints = {};  // between start and goal
  CourseRock goal_rock = {};                // at the goal: the last rock of a terrain (field.h)

  // Start, waypoints and goal, in the order of driving.
  std::vector<CoursePoint> Points() const {
    std::vector<CoursePoint> points{{start_x_m, start_y_m}};
    points.insert(points.end(), waypoints.begin(), waypoints.end());
    points.push_back({goal_x_m, goal_y_m});
    return points;
  }
};

}  // namespace rockyard::terrain
