#include "navigation/gestalt_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/check.h"

namespace rockyard::navigation {
namespace {

constexpr double kLargestHeight_m = 10.0;    // of points above and below R
constexpr std::int64_t kMostPoints = 65536;  // of a cell
// Estimates are taken as if they were here at most; lattice numbers stay far from overflow.
constexpr double kFarthest_m = 1e6;

double Clamped(double x_m) { return std::clamp(x_m, -kFarthest_m, kFarthest_m); }

}  // namespace

GestaltMap::GestaltMap(const GestaltMapParams& params)
    : params_(params),
      cells_(params.grid.nx(), params.grid.ny()),
      planes_(params),
      traversability_(params) {
  grid_.xstep_m = params.grid.xstep_m;
  grid_.ystep_m = params.grid.ystep_m;
  grid_.nx = params.grid.nx();
  grid_.ny = params.grid.ny();
  BeginCycle(0.0, 0.0);
  Evaluate();
}

GestaltMap::LatticeCell GestaltMap::LatticeAt(double x_m, double y_m) const {
  const GestaltGridParams& grid = params_.grid;
  return {static_cast<std::int64_t>(std::floor((x_m - grid.x0_m) / grid.xstep_m)),
          static_cast<std::int64_t>(std::floor((y_m - grid.y0_m) / grid.ystep_m))};
}

math::Vector3 GestaltMap::Centre(int ix, int iy) const {
  const GestaltGridParams& grid = params_.grid;
  return {grid.x0_m + (static_cast<double>(cells_.first_x() + ix) + 0.5) * grid.xstep_m,
          grid.y0_m + (static_cast<double>(cells_.first_y() + iy) + 0.5) * grid.ystep_m, 0.0};
}

bool GestaltMap::IsNear(int ix, int iy) const {
  const math::Vector3 centre = Centre(ix, iy);
  const double dx = centre.x() - rover_x_m_;
  const double dy = centre.y() - rover_y_m_;
  return dx * dx + dy * dy <= params_.grid_dist_timeout_m * params_.grid_dist_timeout_m;
}

bool GestaltMap::InWindow(LatticeCell cell) const {
  return cell.x >= cells_.first_x() && cell.x < cells_.first_x() + cells_.nx() &&
         cell.y >= cells_.first_y() && cell.y < cells_.first_y() + cells_.ny();
}

void GestaltMap::GrowBox(int ix, int iy) {
  if (box_.empty()) {
    box_ = {ix, ix + 1, iy, iy + 1};
    return;
  }
  box_ = {std::min(box_.x, ix), std::max(box_.x_end, ix + 1), std::min(box_.y, iy),
          std::max(box_.y_end, iy + 1)};
}

void GestaltMap::BeginCycle(double x_m, double y_m) {
  EXPECT(std::isfinite(x_m) && std::isfinite(y_m));
  ++cycle_;
  rover_x_m_ = Clamped(x_m);
  rover_y_m_ = Clamped(y_m);
  const LatticeCell rover = LatticeAt(rover_x_m_, rover_y_m_);
  DropOldCells({rover.x - cells_.nx() / 2, rover.y - cells_.ny() / 2});
}

void GestaltMap::DropOldCells(LatticeCell first) {
  const CellBox old = box_;
  const LatticeCell shift{first.x - cells_.first_x(), first.y - cells_.first_y()};
  box_ = {};
  for (int iy = old.y; iy < old.y_end; ++iy) {
    for (int ix = old.x; ix < old.x_end; ++ix) {
      MapCell& cell = cells_.At(ix, iy);
      if (cell.empty()) continue;
      const bool leaves = ix < shift.x || ix >= shift.x + cells_.nx() || iy < shift.y ||
                          iy >= shift.y + cells_.ny();
      if (leaves || !IsNear(ix, iy) || cycle_ - cell.last_cycle > params_.max_idles) {
        cell = {};
      } else {
        GrowBox(ix - static_cast<int>(shift.x), iy - static_cast<int>(shift.y));
      }
    }
  }
  cells_.MoveTo(first.x, first.y);
}

void GestaltMap::AddPoint(const math::Vector3& p_WP_W) {
  const LatticeCell at = LatticeAt(p_WP_W.x(), p_WP_W.y());
  if (!InWindow(at)) return;
  const int ix = static_cast<int>(at.x - cells_.first_x());
  const int iy = static_cast<int>(at.y - cells_.first_y());
  if (!IsNear(ix, iy)) return;
  MapCell& cell = cells_.At(ix, iy);
  cell.last_cycle = cycle_;
  if (cell.moments.count() >= kMostPoints) return;
  cell.moments.AddPoint(math::ToMomentUnits(p_WP_W.x()), math::ToMomentUnits(p_WP_W.y()),
                        math::ToMomentUnits(p_WP_W.z()));
  GrowBox(ix, iy);
}

void GestaltMap::Add(const messages::PointCloud& cloud, const math::Transform& X_WR) {
  const double z_R = X_WR.translation().z();
  for (const math::Vector3& p_RP_R : cloud.points_R) {
    const math::Vector3 p_WP_W = X_WR * p_RP_R;
    // Written so that coordinates that are not numbers fail.
    const bool sound =
        std::abs(p_WP_W.x()) <= 2.0 * kFarthest_m && std::abs(p_WP_W.y()) <= 2.0 * kFarthest_m &&
        std::abs(p_WP_W.z() - z_R) <= kLargestHeight_m && std::abs(p_WP_W.z()) <= kFarthest_m;
    if (sound) AddPoint(p_WP_W);
  }
}

void GestaltMap::MarkObstacle(double x_m, double y_m, double radius_m) {
  EXPECT(std::isfinite(x_m) && std::isfinite(y_m));
  const LatticeCell at = LatticeAt(Clamped(x_m), Clamped(y_m));
  for (int iy = 0; iy < cells_.ny(); ++iy) {
    for (int ix = 0; ix < cells_.nx(); ++ix) {
      const math::Vector3 centre = Centre(ix, iy);
      const bool here = at.x == cells_.first_x() + ix && at.y == cells_.first_y() + iy;
      const bool within = std::hypot(centre.x() - x_m, centre.y() - y_m) <= radius_m;
      if (!here && !within) continue;
      MapCell& cell = cells_.At(ix, iy);
      cell.marked = true;
      cell.last_cycle = cycle_;
      GrowBox(ix, iy);
    }
  }
}

void GestaltMap::Clear() {
  for (int iy = box_.y; iy < box_.y_end; ++iy) {
    for (int ix = box_.x; ix < box_.x_end; ++ix) cells_.At(ix, iy) = {};
  }
  box_ = {};
}

const GoodnessGrid& GestaltMap::Evaluate() {
  const math::Vector3 corner = Centre(0, 0);
  grid_.x0_m = corner.x() - 0.5 * grid_.xstep_m;
  grid_.y0_m = corner.y() - 0.5 * grid_.ystep_m;
  planes_.Fit(cells_, box_);
  steps_.Find(cells_, box_, planes_.reach());
  traversability_.Assess(planes_.planes(), steps_.steps_m(), grid_);
  return grid_;
}

messages::MapView GestaltMap::View() const {
  messages::MapView view{grid_.x0_m, grid_.y0_m, grid_.xstep_m, grid_.ystep_m, grid_.nx,
                         grid_.ny,   {}};
  view.cells.reserve(grid_.cells.size());
  for (int iy = 0; iy < grid_.ny; ++iy) {
    for (int ix = 0; ix < grid_.nx; ++ix) {
      const math::PointMoments& moments = cells_.At(ix, iy).moments;
      const CellValue& value = grid_.Cell(ix, iy);
      const bool has_data = !moments.empty();
      view.cells.push_back({has_data, has_data ? moments.MeanZ_m() : 0.0, value.known,
                            value.goodness, value.certainty});
    }
  }
  return view;
}

}  // namespace rockyard::navigation
