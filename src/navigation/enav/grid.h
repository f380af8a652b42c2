// Square cells in a window that follows the rover over an endless lattice.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "math/pose.h"

namespace rockyard::navigation {

// Cells of the lattice, columns along x. Cell 0 begins at the frame's origin.
struct LatticeCell {
  std::int64_t x = 0;
  std::int64_t y = 0;

  bool operator==(const LatticeCell&) const = default;
};

template <typename Cell>
class RoverGrid {
 public:
  // A window of at least `side_m`, in the middle of which the frame's origin lies.
  RoverGrid(double cell_m, double side_m)
      : cell_m_(cell_m), n_(2 * static_cast<std::int64_t>(std::ceil(0.5 * side_m / cell_m))) {
    cells_.resize(static_cast<std::size_t>(n_ * n_));
    first_ = {-n_ / 2, -n_ / 2};
  }

  double cell_m() const { return cell_m_; }
  std::int64_t n() const { return n_; }
  const LatticeCell& first() const { return first_; }  // lower corner of the window

  LatticeCell CellOf(double x_m, double y_m) const {
    return {static_cast<std::int64_t>(std::floor(x_m / cell_m_)),
            static_cast<std::int64_t>(std::floor(y_m / cell_m_))};
  }
  // Return the middle of a cell, m.
  double MiddleX_m(const LatticeCell& c) const {
    return (static_cast<double>(c.x) + 0.5) * cell_m_;
  }
  double MiddleY_m(const LatticeCell& c) const {
    return (static_cast<double>(c.y) + 0.5) * cell_m_;
  }

  bool Holds(const LatticeCell& c) const {
    return c.x >= first_.x && c.x < first_.x + n_ && c.y >= first_.y && c.y < first_.y + n_;
  }
  // Return a cell of the window.
  Cell& At(const LatticeCell& c) { return cells_[Slot(c)]; }
  const Cell& At(const LatticeCell& c) const { return cells_[Slot(c)]; }
  // Returns null outside of the window.
  const Cell* Find(const LatticeCell& c) const { return Holds(c) ? &At(c) : nullptr; }

  // Moves the window so that the place is in its middle where it is off that by more than a
  // sixteenth of the window; cells that go out are forgotten.
  void Follow(double x_m, double y_m) {
    const LatticeCell c = CellOf(x_m, y_m);
    const std::int64_t off =
        std::max(std::abs(c.x - first_.x - n_ / 2), std::abs(c.y - first_.y - n_ / 2));
    if (off <= n_ / 16) return;
    const RoverGrid old = std::exchange(*this, RoverGrid(*this, {c.x - n_ / 2, c.y - n_ / 2}));
    ForEach([&](const LatticeCell& cell, Cell& content) {
      if (const Cell* kept = old.Find(cell)) content = *kept;
    });
  }

  // Calls visit(LatticeCell, Cell&) for every cell, row by row.
  template <typename Visit>
  void ForEach(Visit&& visit) {
    for (std::int64_t y = first_.y; y < first_.y + n_; ++y) {
      for (std::int64_t x = first_.x; x < first_.x + n_; ++x) visit(LatticeCell{x, y}, At({x, y}));
    }
  }

  // Calls visit(cell, x, y) for every cell that a rectangle touches, and a few at its corners that
  // it does not: |x - middle_x| <= half_x, |y - middle_y| <= half_y in a frame at `pose`. x and y
  // are those of the cell's middle there; cell is null outside of the window.
  template <typename Visit>
  void VisitBox(const math::Pose2& pose, const math::Pose2& middle, double half_x_m,
                double half_y_m, Visit&& visit) const {
    const auto [s, c] = math::SinCos(pose.heading_rad);
    const double centre_x_m = pose.x_m + c * middle.x_m - s * middle.y_m;
    const double centre_y_m = pose.y_m + s * middle.x_m + c * middle.y_m;
    // A cell touches no farther from its middle than half its own width as seen along an axis.
    const double margin_m = 0.5 * cell_m_ * (std::abs(c) + std::abs(s));
    const double reach_x_m = std::abs(c) * half_x_m + std::abs(s) * half_y_m;
    const double reach_y_m = std::abs(s) * half_x_m + std::abs(c) * half_y_m;
    const LatticeCell from = CellOf(centre_x_m - reach_x_m, centre_y_m - reach_y_m);
    const LatticeCell to = CellOf(centre_x_m + reach_x_m, centre_y_m + reach_y_m);
    for (std::int64_t iy = from.y; iy <= to.y; ++iy) {
      for (std::int64_t ix = from.x; ix <= to.x; ++ix) {
        const LatticeCell cell{ix, iy};
        const double dx_m = MiddleX_m(cell) - centre_x_m;
        const double dy_m = MiddleY_m(cell) - centre_y_m;
        const double x_m = c * dx_m + s * dy_m;
        const double y_m = c * dy_m - s * dx_m;
        if (std::abs(x_m) > half_x_m + margin_m || std::abs(y_m) > half_y_m + margin_m) continue;
        visit(Find(cell), middle.x_m + x_m, middle.y_m + y_m);
      }
    }
  }

 private:
  // An empty window elsewhere.
  RoverGrid(const RoverGrid& like, const LatticeCell& first)
      : cell_m_(like.cell_m_), n_(like.n_), first_(first), cells_(like.cells_.size()) {}

  std::size_t Slot(const LatticeCell& c) const {
    return static_cast<std::size_t>((c.y - first_.y) * n_ + c.x - first_.x);
  }

  double cell_m_;
  std::int64_t n_;
  LatticeCell first_;
  std::vector<Cell> cells_;
};

}  // namespace rockyard::navigation
