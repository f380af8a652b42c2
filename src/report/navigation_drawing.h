// One decision of a map-based navigator as picture and data, in the manner of the diagnostic image
// of Goldberg 2002, figure 3. `rockyard replay` writes and tells it. No record depends on it: the
// drawing may change, columns of its CSV are for programs of others.
#pragma once

#include <string>

#include "messages/navigation_view.h"
#include "messages/point_cloud.h"
#include "report/step_scene.h"

namespace rockyard::report {

struct NavigationPicture {
  std::string title;
  messages::NavigationView view;
  StepScene scene;
};

// Returns an SVG file: the course with the path so far (CoursePanel), the view of the front camera
// with the grid (CameraPanel), maps of elevation, goodness (with the candidate arcs) and certainty,
// x to the right and y up in the estimated world frame, and the votes of every candidate in three
// rows (waypoint, hazard, merged). Candidates run from the leftmost to the rightmost turn; those
// with the best vote are underlined, the chosen one is framed.
std::string NavigationSvg(const NavigationPicture& picture);

// Every cell: x_m, y_m (centre), elevation_m (empty without data), goodness, certainty (empty where
// unknown).
std::string MapCsv(const messages::MapView& map);

// Every candidate: kind (forward, backward, point_turn), curvature_per_m, direction, the four
// votes, best, chosen.
std::string VotesCsv(const messages::NavigationView& view);

// Points of a cloud: x_m, y_m, z_m in R.
std::string CloudCsv(const messages::PointCloud& cloud);

// Returns what was decided, in a line: "forward 0.55 /m (vote 213)".
std::string ChosenText(const messages::NavigationView& view);

}  // namespace rockyard::report
