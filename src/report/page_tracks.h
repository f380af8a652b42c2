// Where the drives of a run went, as the report page draws them from above: world frame, whole
// centimetres in the page's data.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "math/pose.h"
#include "messages/estimates.h"
#include "report/trace_path.h"

namespace rockyard::report {

// What all drives of a run share.
struct PageCourse {
  std::string rover;  // its name; "" where its shape is that of no rover that is known
  math::Pose2 start;
  messages::Goal goal;
  double goal_radius_m = 0.0;
  std::vector<messages::Goal> waypoints;  // true, in the order of driving
  std::vector<double> mirror_lines_m;     // y at which operators reflect the rover; mostly none
};

struct PageRock {
  double x_m = 0.0;
  double y_m = 0.0;
  double radius_m = 0.0;  // of a circle that holds it
};

// The true path of one trial, simplified already.
struct PageTrack {
  std::uint64_t trial = 0;
  TracePath path;
  std::vector<PageRock> rocks = {};  // of trials that are drawn by themselves
};

// `Course` of src/web/report/payload.ts.
std::string PageCourseJson(const PageCourse& course);

// Member "tracks" of a run: `Track` of each.
std::string PageTracksJson(std::span<const PageTrack> tracks);

}  // namespace rockyard::report
