#include "trial/course/route_planner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "math/functions.h"
#include "terrain/arena.h"

namespace rockyard::trial {
namespace {

struct Offset {
  int x;
  int y;
};

constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();
// Records depend on this order, which decides among ways of the same cost.
constexpr Offset kNeighbours[] = {{1, 0}, {-1, 0}, {0, 1},  {0, -1},
                                  {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

// Returns how many cells have their centres within the length; one at least.
int Cells(double length_m, double cell_m) {
  constexpr double kRounding = 1e-9;
  return std::max(1, static_cast<int>(std::floor(length_m / cell_m + 0.5 + kRounding)));
}

// Returns the cell of x, -1 or `cells` beyond the grid. What is left of the length belongs to the
// last cell.
int CellAt(double x_m, double min_m, double max_m, double cell_m, int cells) {
  const double cell = std::floor((x_m - min_m) / cell_m);
  const double last = x_m <= max_m ? cells - 1 : cells;
  return static_cast<int>(std::clamp(cell, -1.0, last));
}

// Returns the shortest way over an empty grid, in cells: what ShortestPath expects the rest of a
// way to cost. It must never exceed the true cost, nor fall by more than a step costs, as a closed
// cell is not opened again.
double OctileDistance(int dx, int dy) {
  const int low = std::min(std::abs(dx), std::abs(dy));
  const int high = std::max(std::abs(dx), std::abs(dy));
  return high + (std::numbers::sqrt2 - 1.0) * low;
}

}  // namespace

FreeGrid::FreeGrid(const terrain::Rectangle& bounds, double cell_m)
    : bounds_(bounds),
      cell_m_(cell_m),
      nx_(Cells(bounds.x_max_m - bounds.x_min_m, cell_m)),
      ny_(Cells(bounds.y_max_m - bounds.y_min_m, cell_m)),
      blocked_(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_)) {}

int FreeGrid::Column(double x_m) const {
  return CellAt(x_m, bounds_.x_min_m, bounds_.x_max_m, cell_m_, nx_);
}

int FreeGrid::Row(double y_m) const {
  return CellAt(y_m, bounds_.y_min_m, bounds_.y_max_m, cell_m_, ny_);
}

messages::Goal FreeGrid::Centre(std::size_t index) const {
  const auto columns = static_cast<std::size_t>(nx_);
  const std::size_t column = index % columns;
  const std::size_t row = index / columns;
  return {bounds_.x_min_m + (static_cast<double>(column) + 0.5) * cell_m_,
          bounds_.y_min_m + (static_cast<double>(row) + 0.5) * cell_m_};
}

void FreeGrid::Block(const terrain::Rock& rock, double room_m) {
  const double a_m = rock.semi_axes_m.x() + room_m;
  const double b_m = rock.semi_axes_m.y() + room_m;
  const auto [s, c] = math::SinCos(rock.yaw_rad);
  const int last_x = std::min(Column(rock.center_W.x() + a_m), nx_ - 1);
  const int last_y = std::min(Row(rock.center_W.y() + a_m), ny_ - 1);
  for (int iy = std::max(Row(rock.center_W.y() - a_m), 0); iy <= last_y; ++iy) {
    for (int ix = std::max(Column(rock.center_W.x() - a_m), 0); ix <= last_x; ++ix) {
      const messages::Goal centre = Centre(Index(ix, iy));
      const double dx = centre.x_m - rock.center_W.x();
      const double dy = centre.y_m - rock.center_W.y();
      const double along = (c * dx + s * dy) / a_m;
      const double across = (c * dy - s * dx) / b_m;
      if (along * along + across * across < 1.0) blocked_[Index(ix, iy)] = 1;
    }
  }
}

bool FreeGrid::IsClear(const messages::Goal& from, const messages::Goal& to) const {
  const double length_m = math::Hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  const int steps = 1 + static_cast<int>(2.0 * length_m / cell_m_);
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    if (!IsFree({from.x_m + share * (to.x_m - from.x_m), from.y_m + share * (to.y_m - from.y_m)})) {
      return false;
    }
  }
  return true;
}

std::vector<std::size_t> ShortestPath(const FreeGrid& grid, std::size_t from, std::size_t to) {
  const auto columns = static_cast<std::size_t>(grid.nx());
  const int goal_x = static_cast<int>(to % columns);
  const int goal_y = static_cast<int>(to / columns);
  std::vector<double> cost(grid.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> before(grid.size(), kNowhere);
  // Records depend on this order: least expected cost first, then the smaller index.
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto reach = [&](std::size_t cell, double new_cost, std::size_t parent) {
    if (new_cost >= cost[cell]) return;
    cost[cell] = new_cost;
    before[cell] = parent;
    const int dx = goal_x - static_cast<int>(cell % columns);
    const int dy = goal_y - static_cast<int>(cell / columns);
    open.emplace(new_cost + OctileDistance(dx, dy), cell);
  };
  std::vector<bool> closed(grid.size());
  reach(from, 0.0, kNowhere);
  while (!open.empty() && !closed[to]) {
    const std::size_t cell = open.top().second;
    open.pop();
    if (closed[cell]) continue;
    closed[cell] = true;
    const int x = static_cast<int>(cell % columns);
    const int y = static_cast<int>(cell / columns);
    for (const auto& [dx, dy] : kNeighbours) {
      if (!grid.IsFree(x + dx, y + dy) || !grid.IsFree(x + dx, y) || !grid.IsFree(x, y + dy)) {
        continue;
      }
      const double step = dx != 0 && dy != 0 ? std::numbers::sqrt2 : 1.0;
      reach(grid.Index(x + dx, y + dy), cost[cell] + step, cell);
    }
  }
  std::vector<std::size_t> way;
  if (!closed[to]) return way;
  for (std::size_t cell = to; cell != kNowhere; cell = before[cell]) way.push_back(cell);
  std::reverse(way.begin(), way.end());
  return way;
}

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

// Pulls a way straight: from each corner it leads on to the last cell up to which every cell of the
// way is in clear sight of the corner.
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
  // Without free ends there is no way under this demand; a weaker demand may leave both ends free.
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
  for (const Demand& demand : demands) {
    messages::Route route = Plan(drive, rocks, goal, demand);
    if (!route.corners.empty()) return route;
  }
  return {};
}

}  // namespace rockyard::trial
