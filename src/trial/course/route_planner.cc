#include "trial/course/route_planner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "math/functions.h"
#include "terrain/arena.h"
#include "trial/course/free_grid.h"

namespace rockyard::trial {
namespace {

using messages::Goal;

constexpr double kMaxCells = 1e6;  // beyond it cells grow: a bound of time and memory

// The height of rocks from which on a way keeps clear of them, and by how much.
struct Demand {
  double min_height_m = 0.0;
  double room_m = 0.0;
};

// Returns where the rover's centre may be.
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

// Returns a grid without rocks for where the rover's centre may be; none where that is nowhere.
std::optional<FreeGrid> OpenGrid(const DriveParams& drive, double room_m) {
  const terrain::Rectangle bounds = CentreBounds(drive, room_m);
  const double width_m = bounds.x_max_m - bounds.x_min_m;
  const double height_m = bounds.y_max_m - bounds.y_min_m;
  if (width_m <= 0.0 || height_m <= 0.0) return std::nullopt;
  return FreeGrid(bounds, std::max(drive.course.oracle_route.cell_m,
                                   std::sqrt(width_m * height_m / kMaxCells)));
}

// Returns the shortest way between free points, pulled straight: from each corner it leads on to
// the last cell up to which every cell of the way is in clear sight of the corner. It has no
// corners where there is no way.
messages::Route StraightWay(const FreeGrid& grid, const Goal& start, const Goal& goal) {
  const std::vector<std::size_t> way =
      ShortestPath(grid, grid.Index(grid.Column(start.x_m), grid.Row(start.y_m)),
                   grid.Index(grid.Column(goal.x_m), grid.Row(goal.y_m)));
  messages::Route route;
  if (way.empty()) return route;
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

double Length_m(Goal from, const messages::Route& route) {
  double length_m = 0.0;
  for (const Goal& to : route.corners) {
    length_m += math::Hypot(to.x_m - from.x_m, to.y_m - from.y_m);
    from = to;
  }
  return length_m;
}

// A route, and the demand that it meets.
struct PlannedRoute {
  Demand demand;
  messages::Route route;
};

messages::Route Plan(const DriveParams& drive, std::span<const terrain::Rock> rocks,
                     const Goal& goal, const Demand& demand) {
  std::optional<FreeGrid> grid = OpenGrid(drive, demand.room_m);
  if (!grid) return {};
  for (const terrain::Rock& rock : rocks) {
    if (rock.height_m >= demand.min_height_m) grid->Block(rock, demand.room_m);
  }
  const Goal start{drive.course.start_x_m, drive.course.start_y_m};
  // Without free ends there is no way under this demand; a weaker demand may leave both ends free.
  if (!grid->IsFree(start) || !grid->IsFree(goal)) return {};
  return StraightWay(*grid, start, goal);
}

// The demands from this one on are what a rover needs, rather than what is safe.
constexpr std::size_t kOfNeed = 4;

// Returns the route of the first demand, from that place on, that has one.
PlannedRoute PlanByDemands(const DriveParams& drive, std::span<const terrain::Rock> rocks,
                           const Goal& goal, std::size_t from = 0) {
  const rover::RoverGeometryParams& rover = drive.rover.geometry;
  const RoutePlanParams& params = drive.course.oracle_route;
  const double belly_m = rover.belly_clearance_m;
  const double low_m = std::min(params.low_rock_m, belly_m);
  const double turning_m = 0.5 * math::Hypot(rover.length_m, rover.width_m);
  const double passing_m = 0.5 * rover.width_m;
  const double squeezing_m = passing_m - 0.5 * rover.wheel_width_m;
  // Records depend on the demands: from the most generous to the tightest, the first with a way is
  // taken, so that another margin or one more demand between them changes routes.
  const std::array demands{Demand{low_m, turning_m + params.margin_m},
                           Demand{low_m, passing_m + params.margin_m},
                           Demand{belly_m, turning_m + params.margin_m},
                           Demand{belly_m, passing_m + params.margin_m},
                           Demand{belly_m, passing_m},
                           Demand{belly_m, squeezing_m}};
  for (const Demand& demand : std::span(demands).subspan(from)) {
    messages::Route route = Plan(drive, rocks, goal, demand);
    if (!route.corners.empty()) return {demand, std::move(route)};
  }
  return {};
}

// A rover that knows of the rocks what it has seen, and takes all else for free.
class OptimisticDrive {
 public:
  OptimisticDrive(FreeGrid known, const Demand& demand, std::span<const terrain::Rock> rocks,
                  double range_m)
      : known_(std::move(known)), room_m_(demand.room_m), range_m_(range_m) {
    for (const terrain::Rock& rock : rocks) {
      if (rock.height_m >= demand.min_height_m) unseen_.push_back(&rock);
    }
  }

  // Returns the way that it drives; nothing where it finds none.
  std::optional<double> Way_m(Goal at, const Goal& goal) {
    See(at);
    double way_m = 0.0;
    for (;;) {
      const messages::Route route = StraightWay(known_, at, goal);
      if (route.corners.empty()) return std::nullopt;
      const double driven_m = Follow(route, at);
      way_m += driven_m;
      if (at.x_m == goal.x_m && at.y_m == goal.y_m) return way_m;
    }
  }

 private:
  // Blocks what is seen from a place for the first time; returns whether there was any.
  bool See(const Goal& from) {
    return std::erase_if(unseen_, [&](const terrain::Rock* rock) {
             if (!WidenedOutline(*rock, range_m_).Holds(from)) return false;
             known_.Block(*rock, room_m_);
             return true;
           }) > 0;
  }

  // Drives from `at` along the route until it ends or a rock comes to light on it; moves `at` there
  // and returns the way.
  double Follow(const messages::Route& route, Goal& at) {
    double way_m = 0.0;
    for (std::size_t leg = 0; leg < route.corners.size(); ++leg) {
      const Goal from = at;
      const Goal& to = route.corners[leg];
      const double length_m = math::Hypot(to.x_m - from.x_m, to.y_m - from.y_m);
      const int steps = known_.Steps(from, to);
      for (int i = 1; i <= steps; ++i) {
        at = i == steps ? to : PointBetween(from, to, static_cast<double>(i) / steps);
        if (See(at) && !IsClear(from, route, leg)) {
          return way_m + length_m * i / steps;
        }
      }
      way_m += length_m;
    }
    return way_m;
  }

  // Returns whether the route is clear from a leg on that begins at `from`.
  bool IsClear(Goal from, const messages::Route& route, std::size_t leg) const {
    for (; leg < route.corners.size(); ++leg) {
      if (!known_.IsClear(from, route.corners[leg])) return false;
      from = route.corners[leg];
    }
    return true;
  }

  FreeGrid known_;
  double room_m_;
  double range_m_;
  std::vector<const terrain::Rock*> unseen_;
};

}  // namespace

messages::Route PlanRoute(const DriveParams& drive, std::span<const terrain::Rock> rocks,
                          const Goal& goal) {
  return PlanByDemands(drive, rocks, goal).route;
}

std::optional<double> OptimisticWay_m(const DriveParams& drive,
                                      std::span<const terrain::Rock> rocks, const Goal& goal,
                                      double range_m) {
  const PlannedRoute known = PlanByDemands(drive, rocks, goal, kOfNeed);
  if (known.route.corners.empty()) return std::nullopt;
  const Goal start{drive.course.start_x_m, drive.course.start_y_m};
  OptimisticDrive optimist(*OpenGrid(drive, known.demand.room_m), known.demand, rocks, range_m);
  const std::optional<double> way_m = optimist.Way_m(start, goal);
  if (!way_m) return way_m;
  return std::max(*way_m, Length_m(start, known.route));
}

}  // namespace rockyard::trial
