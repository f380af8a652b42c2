/// @file
/// The ground around a rover, as far as range points have shown it: the mean height of each cell,
/// as in ENav's map, in the odometry frame O. What the example navigators decide by.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "messages/estimates.h"
#include "messages/point_cloud.h"

namespace examples {

namespace messages = rockyard::messages;

/// Returns whether numbers can be calculated with: none is infinite, or no number at all.
inline bool AreSane(double a, double b, double c) {
  return std::abs(a) < 1e6 && std::abs(b) < 1e6 && std::abs(c) < 1e6;
}

/// One cell of the ground.
struct Cell {
  std::int64_t ix = 0;  ///< which cell of the plane it is
  std::int64_t iy = 0;
  double sum_m = 0.0;  ///< of the heights of its points, in O, above where the drive began
  double points = 0.0;
  std::int64_t look = 0;  ///< the newest that saw it; 0: none
  bool felt = false;      ///< the rover felt a hazard here

  /// Returns the mean height of its points. Requires look > 0.
  double Height_m() const { return sum_m / points; }
};

/// A place in O.
struct Place {
  double x_m = 0.0;
  double y_m = 0.0;
};

/// A square of cells that wraps around, so that memory is bounded: a cell is forgotten when another
/// one needs its place.
class GroundMap {
 public:
  static constexpr std::int64_t kSide = 128;  ///< cells; a power of two, so that & wraps

  static constexpr std::int64_t kMemory = 10;

  explicit GroundMap(double cell_m) : cell_m_(cell_m) { Clear(); }

  double cell_m() const { return cell_m_; }
  /// Returns the row or column of the plane that a coordinate lies in.
  std::int64_t Index(double place_m) const {
    return static_cast<std::int64_t>(std::floor(place_m / cell_m_));
  }
  void Clear() { cells_.assign(kSide * kSide, Cell()); }

  /// Returns the cell, or null where nothing is known of it.
  const Cell* Find(std::int64_t ix, std::int64_t iy) const {
    const Cell& cell = cells_[Slot(ix, iy)];
    const bool known = cell.ix == ix && cell.iy == iy && (cell.look > 0 || cell.felt);
    return known ? &cell : nullptr;
  }

  /// Takes the points of a look. Means of all looks are less noisy than those of one. A cell that
  /// is seen again after kMemory looks begins anew: the believed pose has drifted meanwhile.
  void Add(const messages::PointCloud& cloud, const messages::LookMoment& moment) {
    const messages::PoseEstimate& at = moment.odometry;
    const messages::AttitudeEstimate& stance = moment.attitude;
    if (!AreSane(at.x_m, at.y_m, at.heading_rad) ||
        !AreSane(stance.roll_rad, stance.pitch_rad, stance.z_m)) {
      return;
    }
    ++looks_;
    const double cr = std::cos(stance.roll_rad), sr = std::sin(stance.roll_rad);
    const double cp = std::cos(stance.pitch_rad), sp = std::sin(stance.pitch_rad);
    const double ch = std::cos(at.heading_rad), sh = std::sin(at.heading_rad);
    for (const auto& p_R : cloud.points_R) {
      if (!AreSane(p_R.x(), p_R.y(), p_R.z())) continue;
      // R_OR = Rz(heading) Ry(pitch) Rx(roll).
      const double y_m = cr * p_R.y() - sr * p_R.z();
      const double up_m = sr * p_R.y() + cr * p_R.z();
      const double x_m = cp * p_R.x() + sp * up_m;
      const double z_O_m = stance.z_m + (cp * up_m - sp * p_R.x());
      Cell& cell =
          Take(Index(at.x_m + (ch * x_m - sh * y_m)), Index(at.y_m + (sh * x_m + ch * y_m)));
      if (cell.look < looks_ - kMemory) cell.sum_m = cell.points = 0.0;
      cell.look = looks_;
      cell.sum_m += z_O_m;
      cell.points += 1.0;
    }
  }

  /// Marks a place where the rover felt what it did not see.
  void MarkFelt(double x_m, double y_m) { Take(Index(x_m), Index(y_m)).felt = true; }

  /// Returns by how much the ground in a cell rises above the lowest in the cells around it: the
  /// step that a rover meets there, whatever slope it stands on. 0 where nothing is known.
  double Step_m(std::int64_t ix, std::int64_t iy) const {
    const Cell* cell = Find(ix, iy);
    if (cell == nullptr) return 0.0;
    if (cell->felt) return 1.0;
    double low_m = cell->Height_m();
    for (std::int64_t j = iy - 1; j <= iy + 1; ++j) {
      for (std::int64_t i = ix - 1; i <= ix + 1; ++i) {
        const Cell* beside = Find(i, j);
        if (beside != nullptr && beside->look > 0) low_m = std::min(low_m, beside->Height_m());
      }
    }
    return cell->Height_m() - low_m;
  }

  /// Returns the middles of all cells within a square around a place that are steps of more than
  /// `limit_m`.
  std::vector<Place> Obstacles(double x_m, double y_m, double reach_m, double limit_m) const {
    std::vector<Place> found;
    const std::int64_t end_x = Index(x_m + reach_m), end_y = Index(y_m + reach_m);
    for (std::int64_t iy = Index(y_m - reach_m); iy <= end_y; ++iy) {
      for (std::int64_t ix = Index(x_m - reach_m); ix <= end_x; ++ix) {
        if (Step_m(ix, iy) <= limit_m) continue;
        found.push_back(
            {cell_m_ * (static_cast<double>(ix) + 0.5), cell_m_ * (static_cast<double>(iy) + 0.5)});
      }
    }
    return found;
  }

 private:
  static std::size_t Slot(std::int64_t ix, std::int64_t iy) {
    return static_cast<std::size_t>((iy & (kSide - 1)) * kSide + (ix & (kSide - 1)));
  }
  Cell& Take(std::int64_t ix, std::int64_t iy) {
    Cell& cell = cells_[Slot(ix, iy)];
    if (cell.ix != ix || cell.iy != iy) cell = {.ix = ix, .iy = iy};
    return cell;
  }

  double cell_m_;
  std::int64_t looks_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace examples
