#include "trial/course/course_params.h"

#include <algorithm>
#include <cstddef>

#include "math/functions.h"

namespace rockyard::trial {

using core::Assumed;
using core::Published;
using core::Setting;

void RouteMapParams::Visit(core::FieldVisitor& v) {
  v.Choice("source", source,
           Setting("the rocks that a route is planned among: all as they are (oracle), or those "
                   "that the lander's cameras show (course.lander_map)"));
  v.Choice("use", use,
           Setting("navigator: for navigation.navigator route alone; waypoints: its corners are "
                   "waypoints of a rover that looks for hazards itself"));
  v.Real("spacing_m", spacing_m,
         Assumed("use waypoints: a corner nearer than this to the one before, or to the goal, is "
                 "no waypoint",
                 "about a vehicle length; nearer ones are one bend", {0.1, 100.0}, {0.3, 2.0}));
  v.Real("passing_m", passing_m,
         Assumed("use waypoints: believed distance at which a corner is passed; it is too where it "
                 "lies behind",
                 "half a vehicle length: a corner is a bend of a way, no place to be at",
                 {0.0, 100.0}, {0.1, 0.6}));
}

std::vector<messages::Goal> LocalSearchParams::Places(const messages::Goal& told) const {
  std::vector<messages::Goal> places;
  for (std::int64_t square = 1; square <= squares; ++square) {
    const double off_m = spacing_m * static_cast<double>(square);
    places.push_back({told.x_m + off_m, told.y_m + off_m});
    places.push_back({told.x_m - off_m, told.y_m + off_m});
    places.push_back({told.x_m - off_m, told.y_m - off_m});
    places.push_back({told.x_m + off_m, told.y_m - off_m});
  }
  return places;
}

void LocalSearchParams::Visit(core::FieldVisitor& v) {
  v.Integer("squares", squares,
            Setting("squares around the told place whose corners a rover drives to that has not "
                    "found the rock there; 0: it ends its drive there",
                    {0, 100}));
  v.Real("spacing_m", spacing_m,
         Assumed("half the side of the first square, and what each later one adds to it",
                 "about the width that the light stripe's array sweeps on either side (2 x 0.26 "
                 "m); Matthies 1995 sec. 5 names a local search and describes none",
                 {0.1, 100.0}, {0.3, 1.0}));
}

void GoalRockParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled,
            Setting("a rock stands at the true goal, and the drive has reached its goal once the "
                    "rover has found it: once a hazard is believed while the rock is within the "
                    "array's reach, or the rover's body touches it"));
  v.Real(
      "diameter_m", diameter_m,
      Assumed("diameter of that rock, which is round and has the field's profile",
              "'a rock of any reasonable size' (Matthies 1995 sec. 5)", {0.02, 10.0}, {0.15, 0.6}));
  v.Real("height_m", height_m,
         Assumed("its height above the ground",
                 "'a rock of any reasonable size' (Matthies 1995 sec. 5), high enough for a hazard",
                 {0.01, 10.0}, {0.1, 0.4}));
  v.Real("recognition_m", recognition_m,
         Setting("distance from the rover's front to the rock's outline within which the rover "
                 "recognizes it and drives to where it sees it, measured as course.tracking says "
                 "(0: never); Matthies 1995 sec. 8: 'about a vehicle length', 0.6 m",
                 {0.0, 20.0}));
  v.Group("search", search, "what the rover does where it was told and finds no rock");
}

std::vector<messages::Goal> WaypointParams::Places() const {
  std::vector<messages::Goal> places;
  for (std::size_t i = 0; i < std::min(x_m.size(), y_m.size()); ++i) {
    places.push_back({x_m[i], y_m[i]});
  }
  return places;
}

void WaypointParams::Visit(core::FieldVisitor& v) {
  v.Reals("x_m", x_m,
          Setting("x of every waypoint, in the order of driving; none leads straight to the goal",
                  {-1000.0, 1000.0}));
  v.Reals("y_m", y_m, Setting("y of every waypoint", {-1000.0, 1000.0}));
  v.Require("x_m", x_m.size() == y_m.size(), "names another number of waypoints than y_m",
            "give every waypoint one entry of each list");
}

namespace {

// Least distance of a place to drive to from the place before it. Visit requires the same distance
// of the goal from the start (0.01 m2, squared).
constexpr double kShortestLeg_m = 0.1;

bool AreApart(const messages::Goal& a, const messages::Goal& b) {
  return math::Hypot(b.x_m - a.x_m, b.y_m - a.y_m) > kShortestLeg_m;
}

// Returns whether every waypoint is apart from the place before it, and the goal from the last
// waypoint.
bool HasLegs(const CourseParams& course) {
  messages::Goal from{course.start_x_m, course.start_y_m};
  for (const messages::Goal& to : course.Goals()) {
    if (!AreApart(from, to)) return false;
    from = to;
  }
  return true;
}

}  // namespace

std::vector<messages::Goal> CourseParams::Goals() const {
  std::vector<messages::Goal> goals = waypoints.Places();
  goals.push_back({goal_x_m, goal_y_m});
  return goals;
}

double CourseParams::SiteMapSide_m() const {
  double least_x_m = start_x_m, most_x_m = start_x_m;
  double least_y_m = start_y_m, most_y_m = start_y_m;
  for (const messages::Goal& place : Goals()) {
    least_x_m = std::min(least_x_m, place.x_m);
    most_x_m = std::max(most_x_m, place.x_m);
    least_y_m = std::min(least_y_m, place.y_m);
    most_y_m = std::max(most_y_m, place.y_m);
  }
  return std::max(most_x_m - least_x_m, most_y_m - least_y_m) + 2.0 * site_map.margin_m;
}

messages::Goal CourseParams::GoalAt(double time_s) const {
  const double way_m = target_speed_m_s * time_s;
  return {goal_x_m + way_m * math::Cos(target_heading_rad),
          goal_y_m + way_m * math::Sin(target_heading_rad)};
}

messages::Goal CourseParams::LanderPlace() const {
  const double dx = goal_x_m - start_x_m;
  const double dy = goal_y_m - start_y_m;
  const double straight_m = math::Hypot(dx, dy);
  if (straight_m <= 0.0) return {start_x_m, start_y_m};
  const double ahead = designation.lander_ahead_m / straight_m;
  const double left = designation.lander_left_m / straight_m;
  return {start_x_m + ahead * dx - left * dy, start_y_m + ahead * dy + left * dx};
}

double CourseParams::DesignationRange_m(const messages::Goal& place) const {
  const double dx = goal_x_m - start_x_m;
  const double dy = goal_y_m - start_y_m;
  const double straight_m = math::Hypot(dx, dy);
  if (straight_m <= 0.0) return 0.0;
  // Coordinates of the place along the line from start to goal, and to its left.
  const double ahead_m = ((place.x_m - start_x_m) * dx + (place.y_m - start_y_m) * dy) / straight_m;
  const double left_m = ((place.y_m - start_y_m) * dx - (place.x_m - start_x_m) * dy) / straight_m;
  return math::Hypot(ahead_m - designation.lander_ahead_m, left_m - designation.lander_left_m);
}

void CourseParams::Visit(core::FieldVisitor& v) {
  v.Real("start_x_m", start_x_m, Setting("start position", {-1000.0, 1000.0}));
  v.Real("start_y_m", start_y_m, Setting("start position", {-1000.0, 1000.0}));
  v.Angle("start_heading_deg", start_heading_rad,
          Setting("start heading, from +x towards +y", {-180.0, 180.0}));
  v.Real(
      "goal_x_m", goal_x_m,
      Published("goal position", "Matthies 1995 sec. 7: 7.6 m from the start", {-1000.0, 1000.0}));
  v.Real("goal_y_m", goal_y_m, Setting("goal position", {-1000.0, 1000.0}));
  v.Real("goal_radius_m", goal_radius_m,
         Assumed("true distance to the goal within which a declared arrival is true: about one "
                 "vehicle length, from where the rover recognises its target",
                 "about one vehicle length, from where the rover recognises prominent rocks "
                 "(Matthies 1995 sec. 8)",
                 {0.01, 100.0}, {0.3, 1.5}));
  v.Real(
      "target_speed_m_s", target_speed_m_s,
      Setting("speed at which the goal itself moves, from the start of the trial on, whatever "
              "stands in its way; a rover that does not track it (tracking) is told where it began",
              {0.0, 1.0}));
  v.Angle("target_heading_deg", target_heading_rad,
          Setting("heading in which it moves, from +x towards +y", {-180.0, 180.0}));
  v.Integer("trials_per_layout", trials_per_layout,
            Setting("consecutive trials that meet the same rock field; the paper does not say "
                    "whether the runs of a set did",
                    {1, 1e6}));
  v.Group("waypoints", waypoints, "where the rover drives to before the goal");
  v.Group("designation", designation, "the goal and the waypoints that the rover is told");
  v.Group("tracking", tracking, "a sensor that follows the goal, where it is seen");
  v.Group("oracle_route", oracle_route,
          "how the route is planned that navigation.navigator route follows");
  v.Group("route_map", route_map, "by whose knowledge of the rocks it is, and who drives along it");
  v.Group("lander_map", lander_map, "what the lander's cameras show of the rocks");
  v.Group("site_map", site_map, "what the navigator is told of the site before it drives");
  v.Require("site_map",
            site_map.kind == SiteMapKind::kNone || SiteMapSide_m() <= 1000.0 * site_map.cell_m,
            "has more than 1000 cells along a side", "use larger cells, or a smaller margin_m");
  v.Group("goal_rock", goal_rock, "a rock at the goal that the rover has to find");
  const double dx = goal_x_m - start_x_m;
  const double dy = goal_y_m - start_y_m;
  v.Require("goal_x_m", dx * dx + dy * dy > 0.01, "puts the goal within 0.1 m of the start",
            "use a goal that the rover has to drive to, e.g. 7.6");
  v.Require("waypoints.x_m", waypoints.x_m.empty() || HasLegs(*this),
            "names a waypoint within 0.1 m of the one before, of the start or of the goal",
            "leave it out, or move it to where the rover has to drive to");
}

}  // namespace rockyard::trial
