// A plain map of GESTALT to compare the fast one with: it keeps every point, and goes through all
// points of every patch with Eigen's solver. The same readings of Goldberg 2002, section 4, and of
// its table 1, by an independent algorithm.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "navigation/gestalt/goodness_grid.h"
#include "navigation/gestalt/map_params.h"

namespace rockyard::navigation {

class ReferenceMap {
 public:
  explicit ReferenceMap(const GestaltMapParams& params) : p_(params) {}

  // A point of the map's frame.
  void Add(const math::Vector3& point) {
    // The map takes whole micrometres.
    const auto whole = [](double x) { return std::round(x * 1e6) / 1e6; };
    points_[{Column(point.x()), Row(point.y())}].push_back(
        {whole(point.x()), whole(point.y()), whole(point.z())});
  }

  // The value of the cell that holds (x, y), without window, ageing or distance.
  CellValue Evaluate(double x, double y) const {
    const CellValue value = WithoutBorder(Column(x), Row(y));
    if (!value.known || !p_.tests.border) return value;
    bool border = false;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        if (p_.border_neighbours == BorderNeighbours::kFour && dx * dy != 0) continue;
        border = border || !WithoutBorder(Column(x) + dx, Row(y) + dy).known;
      }
    }
    if (!border || value.goodness <= p_.pairs.border.goodness) return value;
    return Cell(p_.pairs.border.goodness, p_.pairs.border.certainty);
  }

 private:
  using Points = std::vector<math::Vector3>;

  struct Plane {
    bool valid = false;
    double residual = 0.0;
    double slope = 0.0;
    math::Vector3 normal = math::Vector3::UnitZ();
  };

  int Column(double x) const {
    return static_cast<int>(std::floor((x - p_.grid.x0_m) / p_.grid.xstep_m));
  }
  int Row(double y) const {
    return static_cast<int>(std::floor((y - p_.grid.y0_m) / p_.grid.ystep_m));
  }

  static math::Vector3 Mean(const Points& points) {
    math::Vector3 sum = math::Vector3::Zero();
    for (const math::Vector3& point : points) sum += point;
    return sum / static_cast<double>(points.size());
  }

  CellValue Cell(std::int64_t goodness, std::int64_t certainty) const {
    const bool full = p_.certainty == CellCertainty::kFull;
    return {static_cast<std::uint8_t>(goodness), static_cast<std::uint8_t>(full ? 255 : certainty),
            true};
  }

  // Cells that a square of the patch's side, centred on the middle of a cell, reaches into.
  static int Reach(double side, double step) {
    int reach = 0;
    while (step * (2 * reach + 1) < side - 1e-6 * step) ++reach;
    return reach;
  }

  // Coverage and data are not asked for again of what is left without outliers.
  Plane FitPlane(std::vector<Points> cells) const {
    for (std::int64_t left_out = 0;; ++left_out) {
      Points all;
      for (const Points& cell : cells) all.insert(all.end(), cell.begin(), cell.end());
      const math::Vector3 mean = Mean(all);
      Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
      for (const math::Vector3& q : all) covariance += (q - mean) * (q - mean).transpose();
      covariance /= static_cast<double>(all.size());
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
      const Eigen::Vector3d values = solver.eigenvalues();
      const math::Vector3 normal = solver.eigenvectors().col(0);
      std::size_t worst = 0;
      double farthest = -1.0;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const double distance = std::abs(normal.dot(Mean(cells[i]) - mean));
        if (distance > farthest) {
          worst = i;
          farthest = distance;
        }
      }
      // A cell in the plane is no outlier.
      if (left_out == p_.outliers_per_cell || cells.size() == 1 || farthest < 1e-6) {
        const bool line = values(1) <= 1e-12 * values(2);  // has no plane
        return {!line && values(1) >= p_.eigen_ratio * values(0),
                std::sqrt(std::max(0.0, values(0))), std::acos(std::min(1.0, std::abs(normal.z()))),
                normal};
      }
      cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(worst));
    }
  }

  CellValue Unknown() const {
    return {static_cast<std::uint8_t>(p_.pairs.unknown.goodness),
            static_cast<std::uint8_t>(p_.pairs.unknown.certainty), false};
  }

  CellValue WithoutBorder(int column, int row) const {
    const int rx = Reach(p_.PatchSide_m(), p_.grid.xstep_m);
    const int ry = Reach(p_.PatchSide_m(), p_.grid.ystep_m);
    std::vector<Points> cells;
    std::map<int, int> columns, rows;
    std::size_t filled = 0;
    for (int y = row - ry; y <= row + ry; ++y) {
      for (int x = column - rx; x <= column + rx; ++x) {
        const auto found = points_.find({x, y});
        if (found == points_.end()) continue;
        cells.push_back(found->second);
        if (static_cast<std::int64_t>(found->second.size()) >= p_.min_cell_points) ++filled;
        ++columns[x];
        ++rows[y];
      }
    }
    // Shares such as 0.6 of 5 cells are whole numbers but for rounding.
    const auto reaches = [](std::size_t count, double share, int of) {
      return static_cast<double>(count) >= share * of - 1e-6;
    };
    if (cells.empty() || !reaches(filled, p_.min_patch_share, (2 * rx + 1) * (2 * ry + 1))) {
      return Unknown();
    }
    double low = 1e9, high = -1e9;
    for (const Points& cell : cells) {
      low = std::min(low, Mean(cell).z());
      high = std::max(high, Mean(cell).z());
    }
    Plane plane = FitPlane(cells);
    plane.valid = plane.valid && reaches(columns.size(), p_.min_cell_coverage, 2 * rx + 1) &&
                  reaches(rows.size(), p_.min_cell_coverage, 2 * ry + 1);
    if (plane.valid && p_.step_reference == StepReference::kPlane) {
      low = 1e9;
      high = -1e9;
      for (const Points& cell : cells) {
        // How far straight up from the plane through the origin with this normal.
        const double above = plane.normal.dot(Mean(cell)) / plane.normal.z();
        low = std::min(low, above);
        high = std::max(high, above);
      }
    }
    return Hazards(high - low, plane);
  }

  CellValue Hazards(double step, const Plane& plane) const {
    const double h = p_.HazardHeight_m();
    double goodness = 255.0;
    std::int64_t certainty = 255;
    // The pair of table 1 is that of the whole obstacle: no hazard is worse.
    const auto hazard = [&](double formula, const GoodnessPair& pair) {
      const double value = std::max(std::floor(formula + 0.5), static_cast<double>(pair.goodness));
      if (value < goodness) {
        goodness = value;
        certainty = pair.certainty;
      }
    };
    const bool step_hazard = p_.tests.step && step >= h / 3.0;
    if (step_hazard) hazard(127.0 * (1.0 - std::min(1.0, step / h)), p_.pairs.step_obst);
    if (!plane.valid) {
      const bool skip = p_.failed_fit == FailedFit::kSkipPlaneTests &&
                        (p_.tests.step || !(p_.tests.rough || p_.tests.pitch));
      const bool kept = p_.failed_fit == FailedFit::kStepOrUnknown && step_hazard;
      return skip || kept ? Cell(static_cast<std::int64_t>(goodness), certainty) : Unknown();
    }
    const double f = p_.roughness_fraction;
    if (p_.tests.rough && plane.residual >= f * h / 3.0) {
      const bool printed = p_.roughness_formula == RoughnessFormula::kAsPrinted;
      const double ratio = printed ? f * plane.residual / h : plane.residual / (f * h);
      hazard(255.0 * (1.0 - std::min(1.0, ratio)), p_.pairs.rough_obst);
    }
    if (p_.tests.pitch) {
      hazard(255.0 * (1.0 - std::min(1.0, plane.slope / p_.rover.max_pitch_rad)),
             p_.pairs.pitch_obst);
    }
    return Cell(static_cast<std::int64_t>(goodness), certainty);
  }

  GestaltMapParams p_;
  std::map<std::pair<int, int>, Points> points_;
};

}  // namespace rockyard::navigation
