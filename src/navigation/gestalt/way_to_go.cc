#include "navigation/gestalt/way_to_go.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "core/check.h"
#include "math/functions.h"

namespace rockyard::navigation {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// Within so many cells of the goal the way is the straight one: bilinear costs round the tip of the
// cone off.
constexpr double kNearCells = 2.0;

// A corner that a search has reached, with its cost so far.
using Reached = std::pair<double, std::size_t>;

}  // namespace

double CrossingCost(double next, double opposite, double side_cost) {
  const double gain = next - opposite;
  if (gain <= 0.0) return next + side_cost;
  if (gain * std::numbers::sqrt2 >= side_cost) return opposite + std::numbers::sqrt2 * side_cost;
  return next + std::sqrt(side_cost * side_cost - gain * gain);
}

void CostField::Search(const messages::Goal& goal, double beyond_per_m) {
  EXPECT(nx > 0 && ny > 0 && cost_per_m.size() == CellIndex(0, ny, nx));
  const int columns = nx + 1;
  to_go.assign(CellIndex(0, ny + 1, columns), kFar);
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> reached;
  const auto reach = [&](int ix, int iy, double cost) {
    double& best = to_go[CellIndex(ix, iy, columns)];
    if (cost >= best) return;
    best = cost;
    reached.emplace(cost, CellIndex(ix, iy, columns));
  };
  const auto from_goal_m = [&](int ix, int iy) {
    return math::Hypot(x0_m + ix * cell_m - goal.x_m, y0_m + iy * cell_m - goal.y_m);
  };
  const double column = (goal.x_m - x0_m) / cell_m;
  const double row = (goal.y_m - y0_m) / cell_m;
  if (column >= 0.0 && column < nx && row >= 0.0 && row < ny) {
    const int ix = static_cast<int>(column);
    const int iy = static_cast<int>(row);
    const double per_m = cost_per_m[CellIndex(ix, iy, nx)];
    for (const int dx : {0, 1}) {
      for (const int dy : {0, 1}) reach(ix + dx, iy + dy, per_m * from_goal_m(ix + dx, iy + dy));
    }
  } else {
    for (int iy = 0; iy <= ny; ++iy) {
      const bool whole_row = iy == 0 || iy == ny;
      for (int ix = 0; ix <= nx; ix += whole_row ? 1 : nx) {
        reach(ix, iy, beyond_per_m * from_goal_m(ix, iy));
      }
    }
  }
  while (!reached.empty()) {
    const auto [cost, corner] = reached.top();
    reached.pop();
    if (cost > to_go[corner]) continue;  // reached again since, and cheaper
    const int ix = static_cast<int>(corner % static_cast<std::size_t>(columns));
    const int iy = static_cast<int>(corner / static_cast<std::size_t>(columns));
    // The other corners of each cell at this one: two along a side, or across to the side between
    // here and the corner opposite to them; and one along the diagonal.
    for (const int dx : {-1, +1}) {
      for (const int dy : {-1, +1}) {
        const int cell_x = dx < 0 ? ix - 1 : ix;
        const int cell_y = dy < 0 ? iy - 1 : iy;
        if (cell_x < 0 || cell_x >= nx || cell_y < 0 || cell_y >= ny) continue;
        const double side = cell_m * cost_per_m[CellIndex(cell_x, cell_y, nx)];
        const double along_x = to_go[CellIndex(ix + dx, iy, columns)];
        const double along_y = to_go[CellIndex(ix, iy + dy, columns)];
        reach(ix + dx, iy, CrossingCost(cost, along_y, side));
        reach(ix, iy + dy, CrossingCost(cost, along_x, side));
        reach(ix + dx, iy + dy, cost + std::numbers::sqrt2 * side);
      }
    }
  }
}

double CostField::At(double column, double row) const {
  const int ix = std::clamp(static_cast<int>(column), 0, nx - 1);
  const int iy = std::clamp(static_cast<int>(row), 0, ny - 1);
  const double right = column - ix;
  const double up = row - iy;
  const double* corner = to_go.data() + CellIndex(ix, iy, nx + 1);
  const double low = (1.0 - right) * corner[0] + right * corner[1];
  const double high = (1.0 - right) * corner[nx + 1] + right * corner[nx + 2];
  return (1.0 - up) * low + up * high;
}

bool CostField::Crosses(double column, double row, double cost) const {
  int ix = std::clamp(static_cast<int>(std::lround(column)), 0, nx);
  int iy = std::clamp(static_cast<int>(std::lround(row)), 0, ny);
  bool was_open = false;
  bool crosses = false;
  for (;;) {
    // On to the next corner on the way, along a side of two cells or across one.
    const double here = to_go[CellIndex(ix, iy, nx + 1)];
    double least = kFar;
    double per_m = 0.0;
    int next_x = ix;
    int next_y = iy;
    for (const int dx : {-1, 0, +1}) {
      for (const int dy : {-1, 0, +1}) {
        const int x = ix + dx;
        const int y = iy + dy;
        if (x < 0 || x > nx || y < 0 || y > ny) continue;
        const double beyond = to_go[CellIndex(x, y, nx + 1)];
        if (beyond >= here) continue;
        double cell_per_m = kFar;
        for (int cy = std::max(0, std::max(iy, y) - 1); cy <= std::min({iy, y, ny - 1}); ++cy) {
          for (int cx = std::max(0, std::max(ix, x) - 1); cx <= std::min({ix, x, nx - 1}); ++cx) {
            cell_per_m = std::min(cell_per_m, cost_per_m[CellIndex(cx, cy, nx)]);
          }
        }
        const double way = beyond + cell_m * math::Hypot(dx, dy) * cell_per_m;
        if (way >= least) continue;
        least = way;
        per_m = cell_per_m;
        next_x = x;
        next_y = y;
      }
    }
    if (next_x == ix && next_y == iy) return false;
    ix = next_x;
    iy = next_y;
    const bool open = per_m < cost;
    if (open && crosses) return true;
    was_open = was_open || open;
    crosses = crosses || (was_open && !open);
  }
}

WayToGo::WayToGo(const GestaltParams& params)
    : params_(params.remedies.cost_to_go),
      cells_(static_cast<int>(std::ceil(params_.memory_m / params.map.grid.xstep_m))) {
  for (int goodness = 0; goodness <= 255; ++goodness) {
    // From 1 at the best goodness to rough_cost just above what is not allowed.
    const double badness = 1.0 - goodness / 255.0;
    const bool blocked = goodness <= params.votes.min_allowed_goodness;
    cost_of_goodness_.push_back(blocked ? params_.blocked_cost
                                        : 1.0 + (params_.rough_cost - 1.0) * badness);
  }
  phase_x_m_ = params.map.grid.x0_m;
  phase_y_m_ = params.map.grid.y0_m;
  field_.cell_m = params.map.grid.xstep_m;
  field_.nx = field_.ny = cells_;
}

void WayToGo::Plan(const GoodnessGrid& grid, const messages::Goal& goal, double x_m, double y_m) {
  goal_ = goal;
  if (!params_.enabled) return;
  Remember(grid);
  Search(params_.seen_again == SeenAgain::kLatest ? latest_ : worst_);
  if (params_.seen_again != SeenAgain::kWorstWhileOpen) return;
  const double column = (x_m - field_.x0_m) / field_.cell_m;
  const double row = (y_m - field_.y0_m) / field_.cell_m;
  if (!field_.Crosses(column, row, params_.blocked_cost)) return;
  // The rover came in where it finds no way out: where looks contradict each other, either is in
  // doubt.
  std::vector<double> doubted;
  for (std::size_t i = 0; i < worst_.size(); ++i) {
    doubted.push_back(std::sqrt(worst_[i] * latest_[i]));
  }
  Search(doubted);
}

void WayToGo::Search(const std::vector<double>& costs) {
  field_.cost_per_m = costs;
  for (double& cost : field_.cost_per_m) {
    if (cost == 0.0) cost = params_.unseen_cost;
  }
  field_.Search(goal_, params_.unseen_cost);
}

double WayToGo::From_m(double x_m, double y_m) const {
  const double straight_m = math::Hypot(goal_.x_m - x_m, goal_.y_m - y_m);
  if (!params_.enabled || straight_m <= kNearCells * field_.cell_m) return straight_m;
  const double column = (x_m - field_.x0_m) / field_.cell_m;
  const double row = (y_m - field_.y0_m) / field_.cell_m;
  const bool inside = column >= 0.0 && column <= cells_ && row >= 0.0 && row <= cells_;
  return inside ? field_.At(column, row) : params_.unseen_cost * straight_m;
}

void WayToGo::Remember(const GoodnessGrid& grid) {
  // The window lies as the grid does, with the rover in the middle.
  const auto first = [&](double grid_m, double phase_m, int grid_cells) {
    return std::llround((grid_m - phase_m) / field_.cell_m) + (grid_cells - cells_) / 2;
  };
  const std::int64_t first_x = first(grid.x0_m, phase_x_m_, grid.nx);
  const std::int64_t first_y = first(grid.y0_m, phase_y_m_, grid.ny);
  worst_ = Moved(worst_, first_x, first_y);
  latest_ = Moved(latest_, first_x, first_y);
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      const CellValue& cell = grid.Cell(ix, iy);
      const int column = ix + (cells_ - grid.nx) / 2;
      const int row = iy + (cells_ - grid.ny) / 2;
      const bool inside = column >= 0 && column < cells_ && row >= 0 && row < cells_;
      if (!cell.known || !inside) continue;
      const std::size_t at = CellIndex(column, row, cells_);
      latest_[at] = cost_of_goodness_[cell.goodness];
      worst_[at] = std::max(worst_[at], latest_[at]);
    }
  }
  first_x_ = first_x;
  first_y_ = first_y;
  field_.x0_m = phase_x_m_ + static_cast<double>(first_x) * field_.cell_m;
  field_.y0_m = phase_y_m_ + static_cast<double>(first_y) * field_.cell_m;
}

std::vector<double> WayToGo::Moved(const std::vector<double>& costs, std::int64_t first_x,
                                   std::int64_t first_y) const {
  std::vector<double> moved(CellIndex(0, cells_, cells_), 0.0);
  for (int iy = 0; iy < cells_ && !costs.empty(); ++iy) {
    for (int ix = 0; ix < cells_; ++ix) {
      const std::int64_t column = first_x + ix - first_x_;
      const std::int64_t row = first_y + iy - first_y_;
      if (column < 0 || column >= cells_ || row < 0 || row >= cells_) continue;
      moved[CellIndex(ix, iy, cells_)] =
          costs[CellIndex(static_cast<int>(column), static_cast<int>(row), cells_)];
    }
  }
  return moved;
}

}  // namespace rockyard::navigation
