#include "trial/told_places.h"

#include <cmath>
#include <cstddef>

#include "trial/goal_designation.h"
#include "trial/lander_map.h"
#include "trial/route_planner.h"

namespace rockyard::trial {
namespace {

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
