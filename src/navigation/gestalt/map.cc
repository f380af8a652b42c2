#include "navigation/gestalt/map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/check.h"
#include "math/functions.h"

namespace rockyard::navigation {
namespace {

constexpr double kLargestHeight_m = 10.0;                // of points above and below R
constexpr std::int64_t kMaxPoints = math::kExactPoints;  // of a cell
// Estimates are taken as if they were here at most; lattice numbers stay far from overflow.
constexpr double kFarthest_m = 1e6;

double Clamped(double x_m) { return std::clamp(x_m, -kFarthest_m, kFarthest_m); }

// Returns the largest whole number that is not above x, which must fit one.
std::int64_t FloorOf(double x) {
  const auto toward_0 = static_cast<std::int64_t>(x);
  return toward_0 - static_cast<std::int64_t>(x < static_cast<double>(toward_0));
}

}  // namespace

// A map begins with an empty cycle around the origin, so that Evaluate always has a grid.
GestaltMap::GestaltMap(const GestaltMapParams& params)
    : params_(params),
      cells_(params.grid.nx(), params.grid.ny()),
      squares_x_m2_(static_cast<std::size_t>(cells_.nx())),
      squares_y_m2_(static_cast<std::size_t>(cells_.ny())),
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
  // floor((x - x0) / step): the lattice goes on beyond the bounds x0 .. xN, which give its phase.
  return {FloorOf((x_m - grid.x0_m) / grid.xstep_m), FloorOf((y_m - grid.y0_m) / grid.ystep_m)};
}

double GestaltMap::CentreX_m(std::int64_t i) const {
  return params_.grid.x0_m + (static_cast<double>(i) + 0.5) * params_.grid.xstep_m;
}

double GestaltMap::CentreY_m(std::int64_t j) const {
  return params_.grid.y0_m + (static_cast<double>(j) + 0.5) * params_.grid.ystep_m;
}

// The squared distance of a cell is the sum of those of its column and row.
void GestaltMap::MeasureDistances(LatticeCell first) {
  for (std::size_t i = 0; i < squares_x_m2_.size(); ++i) {
    const double distance = CentreX_m(first.x + static_cast<std::int64_t>(i)) - rover_x_m_;
    squares_x_m2_[i] = distance * distance;
  }
  for (std::size_t j = 0; j < squares_y_m2_.size(); ++j) {
    const double distance = CentreY_m(first.y + static_cast<std::int64_t>(j)) - rover_y_m_;
    squares_y_m2_[j] = distance * distance;
  }
}

// Keeps the box of cells that may hold something: loops need not visit the rest of the window.
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
  // The rover is in the middle cell of the window, the upper of two.
  const LatticeCell first{rover.x - cells_.nx() / 2, rover.y - cells_.ny() / 2};
  MeasureDistances(first);
  DropOldCells(first);
  cells_.MoveTo(first.x, first.y);
}

// Step "cells are zeroed" of the paper: cells that leave the window, lie too far away, or got no
// data for long.
void GestaltMap::DropOldCells(LatticeCell first) {
  const CellBox old = box_;
  box_ = {};
  for (int iy = old.y; iy < old.y_end; ++iy) {
    for (int ix = old.x; ix < old.x_end; ++ix) {
      MapCell& cell = cells_.At(ix, iy);
      if (cell.empty()) continue;
      // Where it will be in the window.
      const std::int64_t column = cells_.first_x() + ix - first.x;
      const std::int64_t row = cells_.first_y() + iy - first.y;
      const bool stays = column >= 0 && column < cells_.nx() && row >= 0 && row < cells_.ny() &&
                         IsNear(static_cast<int>(column), static_cast<int>(row)) &&
                         cycle_ - cell.last_cycle <= params_.max_idles;
      if (stays) {
        GrowBox(static_cast<int>(column), static_cast<int>(row));
      } else {
        cell = {};
      }
    }
  }
}

PointSieve GestaltMap::Sieve() const {
  const GestaltGridParams& grid = params_.grid;
  return {.x = {.origin_m = grid.x0_m,
                .step_m = grid.xstep_m,
                .rover_m = rover_x_m_,
                .first = static_cast<double>(cells_.first_x()),
                .cells = static_cast<double>(cells_.nx()),
                .wrap = static_cast<double>(cells_.wrap_x())},
          .y = {.origin_m = grid.y0_m,
                .step_m = grid.ystep_m,
                .rover_m = rover_y_m_,
                .first = static_cast<double>(cells_.first_y()),
                .cells = static_cast<double>(cells_.ny()),
                .wrap = static_cast<double>(cells_.wrap_y())},
          .largest_xy_m = 2.0 * kFarthest_m,
          .largest_z_m = kFarthest_m,
          .largest_height_m = kLargestHeight_m,
          .largest_square_m2 = params_.grid_dist_timeout_m * params_.grid_dist_timeout_m};
}

// The believed pose takes points from R into the map's frame (map.h).
void GestaltMap::Add(const messages::PointCloud& cloud, const math::Transform& X_WR) {
  const PointSieve sieve = Sieve();
  SiftedPoints sifted;
  std::span<const math::Vector3> rest_R(cloud.points_R);
  while (!rest_R.empty()) {
    const auto points_R = rest_R.first(std::min(rest_R.size(), SiftedPoints::kMost));
    rest_R = rest_R.subspan(points_R.size());
    Sift(sieve, points_R, X_WR, sifted);
    if (sifted.count == 0) continue;
    for (const std::size_t i : std::span(sifted.taken).first(sifted.count)) {
      MapCell& cell = cells_.InSlot(static_cast<std::size_t>(sifted.slots[i]));
      cell.last_cycle = cycle_;
      // Beyond this number sums could run over 2^64; the cell counts as seen all the same.
      if (cell.moments.count() >= kMaxPoints) continue;
      cell.moments.AddPoint(sifted.x[i], sifted.y[i], sifted.z[i]);
    }
    GrowBox(static_cast<int>(sifted.first_x), static_cast<int>(sifted.first_y));
    GrowBox(static_cast<int>(sifted.last_x), static_cast<int>(sifted.last_y));
  }
}

void GestaltMap::MarkObstacle(double x_m, double y_m, double radius_m) {
  EXPECT(std::isfinite(x_m) && std::isfinite(y_m));
  const LatticeCell at = LatticeAt(Clamped(x_m), Clamped(y_m));
  for (int iy = 0; iy < cells_.ny(); ++iy) {
    for (int ix = 0; ix < cells_.nx(); ++ix) {
      // The cell itself is marked, however small the radius.
      const bool here = at.x == cells_.first_x() + ix && at.y == cells_.first_y() + iy;
      const bool within = math::Hypot(CentreX_m(cells_.first_x() + ix) - x_m,
                                      CentreY_m(cells_.first_y() + iy) - y_m) <= radius_m;
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

// Step 3 of Goldberg 2002: planes, steps, goodness.
const GoodnessGrid& GestaltMap::Evaluate() {
  // The lower left corner of the window.
  grid_.x0_m = CentreX_m(cells_.first_x()) - 0.5 * grid_.xstep_m;
  grid_.y0_m = CentreY_m(cells_.first_y()) - 0.5 * grid_.ystep_m;
  planes_.Fit(cells_, box_);
  if (params_.step_reference == StepReference::kLevel) {
    steps_.Find(cells_, box_, planes_.reach());
  } else {
    steps_.FindFromPlanes(cells_, box_, planes_.reach(), planes_.planes());
  }
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
      // Heights are those of the data, not of the patch.
      view.cells.push_back({has_data, has_data ? moments.MeanZ_m() : 0.0, value.known,
                            value.goodness, value.certainty});
    }
  }
  return view;
}

}  // namespace rockyard::navigation
