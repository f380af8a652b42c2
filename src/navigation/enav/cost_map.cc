#include "navigation/enav/cost_map.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>

#include "math/functions.h"
#include "math/plane_fit.h"

namespace rockyard::navigation {
namespace {

constexpr double kImpassable = std::numeric_limits<double>::infinity();

}  // namespace

CostMap::CostMap(const EnavMapParams& params, double speed_m_s, double clearance_m)
    : params_(params),
      flat_s_per_m_(1.0 / speed_m_s),
      clearance_m_(clearance_m),
      grid_(params.cost_cell_m, params.cost_side_m) {}

void CostMap::Add(const math::Vector3& point) {
  const LatticeCell at = grid_.CellOf(point.x(), point.y());
  if (!grid_.Holds(at)) return;
  math::PointMoments& points = grid_.At(at).points;
  if (points.count() == math::kExactPoints) return;
  points.AddPoint(math::ToMomentUnits(point.x()), math::ToMomentUnits(point.y()),
                  math::ToMomentUnits(point.z()));
}

void CostMap::Update(double goal_x_m, double goal_y_m) {
  goal_x_m_ = goal_x_m;
  goal_y_m_ = goal_y_m;
  grid_.ForEach([&](const LatticeCell& at, CostCell&) { Judge(at); });
  Dijkstra(goal_x_m, goal_y_m);
}

void CostMap::Judge(const LatticeCell& at) {
  CostCell& cell = grid_.At(at);
  cell.cost_s_per_m = params_.unseen_factor * flat_s_per_m_;
  if (cell.points.empty()) return;
  math::PointMoments around;
  for (std::int64_t y = at.y - params_.fit_cells; y <= at.y + params_.fit_cells; ++y) {
    for (std::int64_t x = at.x - params_.fit_cells; x <= at.x + params_.fit_cells; ++x) {
      if (const CostCell* near = grid_.Find({x, y})) around += near->points;
    }
  }
  if (around.count() < params_.min_points) return;
  const math::PlaneFit plane = math::FitPlane(math::Spread(around).covariance_m2);
  const double tilt_rad = plane.Slope_rad();
  if (plane.eigen_ratio < params_.eigen_ratio || tilt_rad >= params_.extreme_tilt_rad) {
    cell.cost_s_per_m = kImpassable;
    return;
  }
  const double rough = plane.residual_m / clearance_m_;
  cell.cost_s_per_m =
      flat_s_per_m_ * (1.0 + params_.tilt_weight * tilt_rad / params_.extreme_tilt_rad +
                       params_.roughness_weight * rough * rough);
}

double CostMap::Beyond_s(double x_m, double y_m) const {
  return params_.unseen_factor * flat_s_per_m_ * math::Hypot(x_m - goal_x_m_, y_m - goal_y_m_);
}

// Between the middles of eight neighbours, half of the way at the cost of either. It begins in the
// goal's cell, or, where that lies beyond the window, at the window's edge.
void CostMap::Dijkstra(double goal_x_m, double goal_y_m) {
  using Entry = std::tuple<double, std::int64_t, std::int64_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto reach = [&](const LatticeCell& at, double to_go_s) {
    CostCell& cell = grid_.At(at);
    if (!(to_go_s < cell.to_go_s)) return;
    cell.to_go_s = to_go_s;
    open.emplace(to_go_s, at.y, at.x);
  };
  grid_.ForEach([](const LatticeCell&, CostCell& cell) { cell.to_go_s = kImpassable; });
  const LatticeCell goal = grid_.CellOf(goal_x_m, goal_y_m);
  if (grid_.Holds(goal)) {
    // A goal on ground that cannot be crossed is driven to all the same, as far as ACE allows.
    double& cost_s_per_m = grid_.At(goal).cost_s_per_m;
    if (!std::isfinite(cost_s_per_m)) cost_s_per_m = params_.unseen_factor * flat_s_per_m_;
    reach(goal, 0.0);
  } else {
    const LatticeCell first = grid_.first();
    const std::int64_t last = grid_.n() - 1;
    grid_.ForEach([&](const LatticeCell& at, CostCell& cell) {
      const std::int64_t x = at.x - first.x, y = at.y - first.y;
      const bool edge = x == 0 || y == 0 || x == last || y == last;
      if (edge && std::isfinite(cell.cost_s_per_m)) {
        reach(at, Beyond_s(grid_.MiddleX_m(at), grid_.MiddleY_m(at)));
      }
    });
  }
  while (!open.empty()) {
    const auto [to_go_s, y, x] = open.top();
    open.pop();
    const CostCell& cell = grid_.At({x, y});
    if (to_go_s > cell.to_go_s) continue;
    for (std::int64_t dy = -1; dy <= 1; ++dy) {
      for (std::int64_t dx = -1; dx <= 1; ++dx) {
        const LatticeCell next{x + dx, y + dy};
        if ((dx == 0 && dy == 0) || !grid_.Holds(next)) continue;
        const double way_m = grid_.cell_m() * std::sqrt(static_cast<double>(dx * dx + dy * dy));
        const double half_s = 0.5 * way_m * (cell.cost_s_per_m + grid_.At(next).cost_s_per_m);
        if (std::isfinite(half_s)) reach(next, to_go_s + half_s);
      }
    }
  }
}

double CostMap::Cost_s_per_m(double x_m, double y_m) const {
  const CostCell* cell = grid_.Find(grid_.CellOf(x_m, y_m));
  return cell != nullptr ? cell->cost_s_per_m : params_.unseen_factor * flat_s_per_m_;
}

double CostMap::ToGo_s(double x_m, double y_m) const {
  const CostCell* own = grid_.Find(grid_.CellOf(x_m, y_m));
  if (own == nullptr) return Beyond_s(x_m, y_m);
  if (!std::isfinite(own->to_go_s)) return kImpassable;
  const double u = x_m / grid_.cell_m() - 0.5;
  const double v = y_m / grid_.cell_m() - 0.5;
  const LatticeCell corner{static_cast<std::int64_t>(std::floor(u)),
                           static_cast<std::int64_t>(std::floor(v))};
  double sum_s = 0.0, weight = 0.0;
  for (std::int64_t i = 0; i < 4; ++i) {
    const LatticeCell at{corner.x + i % 2, corner.y + i / 2};
    const CostCell* cell = grid_.Find(at);
    if (cell == nullptr || !std::isfinite(cell->to_go_s)) continue;
    const double w = (1.0 - std::abs(u - static_cast<double>(at.x))) *
                     (1.0 - std::abs(v - static_cast<double>(at.y)));
    sum_s += w * cell->to_go_s;
    weight += w;
  }
  return sum_s / weight;
}

}  // namespace rockyard::navigation
