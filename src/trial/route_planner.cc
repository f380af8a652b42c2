#include "trial/route_planner.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "terrain/arena.h"
#include "trial/free_grid.h"

namespace rockyard::trial {
namespace {

using messages::Goal;

constexpr double kMaxCells = 1e6;

// What a way keeps clear of, and by how much.
struct Demand {
  double min_height_m = 0.0;
  double room_m = 0.0;
};

// Where the rover's centre may be.
terrain::Rectangle CentreBounds(const DriveParams& drive, double room_m) {
  const terrain::ArenaParams& arena = drive.terrain.arena;
  terrain::Rectangle bounds = terrain::DrivableBounds(arena);
  if (arena.kind == terrain::ArenaKind::kOpen) bounds = terrain::LayoutBounds(drive.terrain);
  if (arena.kind == terrain::ArenaKind::kWalled) {
    bounds = {bounds.x_min_m + room_m, bounds.x_max_m - room_m, bounds.y_min_m + room_m,
              bounds.y_max_m - room_m};
  }
  if (arena.kind == terrain::ArenaKind::kVirtualReflected) {
    bounds.y_min_m = -arena.MirrorLine();
    bounds.y_max_m = arena.MirrorLine();
  }
  return bounds;
}

// From each corner on to the farthest cell of the way that can be seen from it, as far as every
// cell before is seen too.
messages::Route PullStraight(const FreeGrid& grid, const std::vector<std::size_t>& way,
                             const Goal& start, const Goal& goal) {
  messages::Route route;
  Goal from = start;
  for (std::size_t i = 1; i + 1 < way.size(); ++i) {
    const bool last = i + 2 == way.size();
    const Goal ahead = last ? goal : grid.Centre(way[i + 1]);
    if (grid.IsClear(from, ahead)) continue;
    from = grid.Centre(way[i]);
    route.corners.push_back(from);
  }
  route.corners.push_back(goal);
  return route;
}

messages::Route Plan(const DriveParams& drive, std::span<const terrain::Rock> rocks,
                     const Goal& goal, const Demand& demand) {
  const terrain::Rectangle bounds = CentreBounds(drive, demand.room_m);
  const double width_m = bounds.x_max_m - bounds.x_min_m;
  const double height_m = bounds.y_max_m - bounds.y_min_m;
  if (width_m <= 0.0 || height_m <= 0.0) return {};
  FreeGrid grid(bounds, std::max(drive.course.oracle_route.cell_m,
                                 std::sqrt(width_m * height_m / kMaxCells)));
  for (const terrain::Rock& rock : rocks) {
    if (rock.height_m >= demand.min_height_m) grid.Block(rock, demand.room_m);
  }
  const Goal start{drive.course.start_x_m, drive.course.start_y_m};
  if (!grid.IsFree(start) || !grid.IsFree(goal)) return {};
  const std::vector<std::size_t> way =
      ShortestPath(grid, grid.Index(grid.Column(start.x_m), grid.Row(start.y_m)),
                   grid.Index(grid.Column(goal.x_m), grid.Row(goal.y_m)));
  return way.empty() ? messages::Route() : PullStraight(grid, way, start, goal);
}

}  // namespace

messages::Route PlanRoute(const DriveParams& drive, std::span<const terrain::Rock> rocks,
                          const Goal& goal) {
  const rover::RoverGeometryParams& rover = drive.rover.geometry;
  const RoutePlanParams& params = drive.course.oracle_route;
  const double belly_m = rover.belly_clearance_m;
  const double low_m = std::min(params.low_rock_m, belly_m);
  const double turning_m = 0.5 * std::hypot(rover.length_m, rover.width_m);
  const double passing_m = 0.5 * rover.width_m;
  const double squeezing_m = passing_m - 0.5 * rover.wheel_width_m;
  const std::array demands{Demand{low_m, turning_m + params.margin_m},
                           Demand{low_m, passing_m + params.margin_m},
                           Demand{belly_m, turning_m + params.margin_m},
                           Demand{belly_m, passing_m + params.margin_m},
                           Demand{belly_m, passing_m},
                           Demand{belly_m, squeezing_m}};
  for (const Demand& demand : demands) {
    messages::Route route = Plan(drive, rocks, goal, demand);
    if (!route.corners.empty()) return route;
  }
  return {};
}

}  // namespace rockyard::trial
