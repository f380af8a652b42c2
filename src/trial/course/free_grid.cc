#include "trial/course/free_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "math/functions.h"

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

WidenedOutline::WidenedOutline(const terrain::Rock& rock, double room_m)
    : center_W_{rock.center_W.x(), rock.center_W.y()},
      a_m_(rock.semi_axes_m.x() + room_m),
      b_m_(rock.semi_axes_m.y() + room_m),
      turn_(math::SinCos(rock.yaw_rad)) {}

bool WidenedOutline::Holds(const messages::Goal& point) const {
  const double dx = point.x_m - center_W_.x_m;
  const double dy = point.y_m - center_W_.y_m;
  const double along = (turn_.cos * dx + turn_.sin * dy) / a_m_;
  const double across = (turn_.cos * dy - turn_.sin * dx) / b_m_;
  return along * along + across * across < 1.0;
}

messages::Goal PointBetween(const messages::Goal& from, const messages::Goal& to, double share) {
  return {from.x_m + share * (to.x_m - from.x_m), from.y_m + share * (to.y_m - from.y_m)};
}

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
  const WidenedOutline outline(rock, room_m);
  const int last_x = std::min(Column(rock.center_W.x() + a_m), nx_ - 1);
  const int last_y = std::min(Row(rock.center_W.y() + a_m), ny_ - 1);
  for (int iy = std::max(Row(rock.center_W.y() - a_m), 0); iy <= last_y; ++iy) {
    for (int ix = std::max(Column(rock.center_W.x() - a_m), 0); ix <= last_x; ++ix) {
      if (outline.Holds(Centre(Index(ix, iy)))) blocked_[Index(ix, iy)] = 1;
    }
  }
}

int FreeGrid::Steps(const messages::Goal& from, const messages::Goal& to) const {
  const double length_m = math::Hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  return 1 + static_cast<int>(2.0 * length_m / cell_m_);
}

bool FreeGrid::IsClear(const messages::Goal& from, const messages::Goal& to) const {
  const int steps = Steps(from, to);
  for (int i = 0; i <= steps; ++i) {
    if (!IsFree(PointBetween(from, to, static_cast<double>(i) / steps))) return false;
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

}  // namespace rockyard::trial
