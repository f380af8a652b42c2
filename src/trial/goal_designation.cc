#include "trial/goal_designation.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/distributions.h"
#include "trial/lander_map.h"
#include "trial/route_planner.h"

namespace rockyard::trial {
namespace {

// From the lander's cameras to a place.
struct LineOfSight {
  double range_m = 0.0;
  double along_x = 1.0;  // unit vector
  double along_y = 0.0;
};

LineOfSight SightOf(const messages::Goal& place, const CourseParams& course) {
  const double dx = course.goal_x_m - course.start_x_m;
  const double dy = course.goal_y_m - course.start_y_m;
  const double straight_m = std::hypot(dx, dy);
  const double ahead = course.designation.lander_ahead_m / straight_m;
  const double left = course.designation.lander_left_m / straight_m;
  const double sight_x_m = (place.x_m - course.start_x_m) - ahead * dx + left * dy;
  const double sight_y_m = (place.y_m - course.start_y_m) - ahead * dy - left * dx;
  const double range_m = std::hypot(sight_x_m, sight_y_m);
  if (range_m <= 0.0) return {};
  return {range_m, sight_x_m / range_m, sight_y_m / range_m};
}

// Numbers of one substream.
struct Draws {
  double crossrange = 0.0;  // standard normal, as the next
  double downrange = 0.0;
  double pan = 0.0;  // uniform from -1 to 1
};

Draws Draw(core::TrialKey key, std::uint32_t substream) {
  core::RandomStream stream(key, core::Purpose::kGoalDesignation, substream);
  Draws draws;
  draws.crossrange = core::SampleNormal(stream, 0.0, 1.0);
  draws.downrange = core::SampleNormal(stream, 0.0, 1.0);
  draws.pan = core::SampleUniform(stream, -1.0, 1.0);
  return draws;
}

messages::Goal Designated(const messages::Goal& truth, const CourseParams& course,
                          const Draws& draws) {
  if (!course.designation.enabled) return truth;
  const LineOfSight sight = SightOf(truth, course);
  const DesignationErrors errors = course.designation.ErrorsAt(sight.range_m);
  const double pan = course.designation.pan_kind == PanError::kFixed ? 1.0 : draws.pan;
  const double downrange_m = draws.downrange * errors.downrange_sd_m;
  const double left_m = draws.crossrange * errors.crossrange_sd_m + pan * errors.crossrange_bias_m;
  return {truth.x_m + downrange_m * sight.along_x - left_m * sight.along_y,
          truth.y_m + downrange_m * sight.along_y + left_m * sight.along_x};
}

bool AreSpaced(const messages::Goal& a, const messages::Goal& b, double spacing_m) {
  return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) >= spacing_m;
}

// Corners that are far enough from the place kept before them and from the end.
std::vector<messages::Goal> Thinned(const messages::Route& route, const messages::Goal& start,
                                    const messages::Goal& goal, double spacing_m) {
  std::vector<messages::Goal> places;
  messages::Goal from = start;
  for (std::size_t i = 0; i + 1 < route.corners.size(); ++i) {
    const messages::Goal& corner = route.corners[i];
    if (!AreSpaced(from, corner, spacing_m) || !AreSpaced(corner, goal, spacing_m)) continue;
    places.push_back(corner);
    from = corner;
  }
  places.push_back(goal);
  return places;
}

}  // namespace

double PanError_rad(const DesignationParams& designation, core::TrialKey key) {
  if (!designation.enabled) return 0.0;
  const bool fixed = designation.pan_kind == PanError::kFixed;
  return designation.pan_error_rad * (fixed ? 1.0 : Draw(key, 0).pan);
}

messages::Goal DesignatedGoal(const CourseParams& course, core::TrialKey key) {
  return Designated({course.goal_x_m, course.goal_y_m}, course, Draw(key, 0));
}

std::vector<messages::Goal> DesignatedGoals(const CourseParams& course, core::TrialKey key) {
  std::vector<messages::Goal> goals = course.waypoints.Places();
  const double pan = Draw(key, 0).pan;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    Draws draws = Draw(key, static_cast<std::uint32_t>(i + 1));
    draws.pan = pan;
    goals[i] = Designated(goals[i], course, draws);
  }
  goals.push_back(DesignatedGoal(course, key));
  return goals;
}

sensing::LanderPlace LanderPlaceOf(const CourseParams& course, core::TrialKey key) {
  const messages::Goal place = course.LanderPlace();
  return {
      .x_m = place.x_m, .y_m = place.y_m, .pan_error_rad = PanError_rad(course.designation, key)};
}

messages::Route ToldRoute(const DriveParams& drive, const terrain::Terrain& terrain,
                          core::TrialKey key, const messages::Goal& goal) {
  if (drive.course.route_map.source == RouteMap::kOracle) {
    return PlanRoute(drive, terrain.rocks(), goal);
  }
  std::vector<terrain::Rock> rocks;
  for (const MappedRock& known : MapFromLander(drive.course, terrain, key)) {
    rocks.push_back(known.rock);
  }
  return PlanRoute(drive, rocks, goal);
}

std::vector<messages::Goal> ToldPlaces(const DriveParams& drive, const terrain::Terrain& terrain,
                                       core::TrialKey key) {
  const RouteMapParams& map = drive.course.route_map;
  if (map.use != RouteUse::kWaypoints) return DesignatedGoals(drive.course, key);
  const messages::Goal goal = DesignatedGoal(drive.course, key);
  return Thinned(ToldRoute(drive, terrain, key, goal),
                 {drive.course.start_x_m, drive.course.start_y_m}, goal, map.spacing_m);
}

}  // namespace rockyard::trial
