// A plain map of GESTALT to compare the fast one with: it keeps every point, and goes through all
// points of every patch with Eigen's solver. The same readings of Goldberg 2002, section 4, and of
// its table 1, by an independent algorithm.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "math/decompositions.h"
#include "navigation/gestalt/goodness_grid.h"
#include "navigation/gestalt/map_params.h"
#include "navigation/gestalt/splines.h"

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
      const math::SingularValues eigen = math::SingularValuesOf(covariance);  // is not negative
      const Eigen::Vector3d values = eigen.values.reverse();
      const math::Vector3 normal = eigen.U.col(2);
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

// Plain votes on splines to compare the fast ones with: every spline is made anew from its start,
// each of its places by one integral from there, and judged by VoteOnPath.

inline bool RateIsFeasible(const GestaltParams& params, double full_speed_m_s,
                           const Spline& spline) {
  const CurvatureLaw law(params.splines.law, params.speed);
  // The largest change in time between places that are close together, by the speed law. Just
  // beyond a knot stands for just at it.
  for (int i = 0; i < 2000; ++i) {
    const double s_m = spline.length_m * (i + 0.5) / 2000.0;
    const double share = params.speed.min_speed_share;
    const double way =
        (std::abs(CurvatureAt(spline, s_m, law)) - params.speed.full_speed_curvature_per_m) /
        (params.speed.slow_curvature_per_m - params.speed.full_speed_curvature_per_m);
    const double speed_m_s =
        full_speed_m_s * (1.0 - (1.0 - share) * std::min(1.0, std::max(0.0, way)));
    const double rate = std::abs(CurvatureRateAt(spline, s_m, law)) * speed_m_s;
    if (rate > params.splines.max_curvature_rate_per_m_s) return false;
  }
  return true;
}

inline messages::SplineVote ReferenceVote(const GestaltParams& params, const GoodnessGrid& grid,
                                          const messages::PoseEstimate& start,
                                          const messages::Goal& goal, const Spline& spline) {
  const CurvatureLaw law(params.splines.law, params.speed);
  const PathSampling sampling =
      SamplePaths(params.plan, std::min(params.map.grid.xstep_m, params.map.grid.ystep_m));
  const double distance_m = std::hypot(goal.x_m - start.x_m, goal.y_m - start.y_m);
  std::vector<PathPoint> points;
  for (std::size_t k = 0; k < sampling.CountWithin(distance_m); ++k) {
    const math::Pose2 p = AlongSpline({}, spline, 0.0, sampling.distance_m[k], law);
    if (k > 0 && std::abs(p.heading_rad) > params.plan.max_path_turn_rad) break;
    points.push_back({p.x_m, p.y_m});
  }
  HazardVote hazard = VoteOnPath(grid, start, points, sampling.weight,
                                 params.votes.min_allowed_goodness, params.plan.unknown_cells);
  const auto rounded = [&params](double vote) {
    return params.votes.whole_numbers ? std::floor(vote + 0.5) : vote;
  };
  hazard = {rounded(hazard.goodness), rounded(hazard.certainty)};
  messages::SplineVote vote{
      .spline = spline, .hazard = hazard.goodness, .hazard_certainty = hazard.certainty};
  // e: between the heading after w and the direction from there to the goal.
  const double w_m = std::min(params.splines.waypoint_m, distance_m);
  const math::Pose2 p = AlongSpline({}, spline, 0.0, w_m, law);
  const double cosine = std::cos(start.heading_rad);
  const double sine = std::sin(start.heading_rad);
  const double to_x = goal.x_m - start.x_m - cosine * p.x_m + sine * p.y_m;
  const double to_y = goal.y_m - start.y_m - sine * p.x_m - cosine * p.y_m;
  const double heading = start.heading_rad + p.heading_rad;
  vote.waypoint_error_rad = std::atan2(std::cos(heading) * to_y - std::sin(heading) * to_x,
                                       std::cos(heading) * to_x + std::sin(heading) * to_y);
  // The goal is a disc.
  const double width = std::min(1.0, params.waypoints.goal_tolerance_m / std::hypot(to_x, to_y));
  double miss = std::max(0.0, std::abs(vote.waypoint_error_rad) - std::asin(width));
  if (width >= 1.0) miss = 0.0;
  const double spacing =
      2.0 * params.arcs.max_curvature_per_m / static_cast<double>(params.arcs.num_forward_arcs - 1);
  const double index = miss / (params.drive.step_m * spacing);
  const bool ahead = cosine * (goal.x_m - start.x_m) + sine * (goal.y_m - start.y_m) >= 0.0;
  vote.waypoint = rounded((ahead ? 255.0 : 128.0) *
                          std::exp(-0.5 * index * index / params.waypoints.vote_index_variance));
  vote.merged = rounded(MergeVotes(hazard, vote.waypoint, params.waypoints.waypoint_certainty,
                                   params.votes.min_vote_goodness));
  return vote;
}

// All splines, without whether they are feasible; by the first knot from right to left, then by the
// second one.
inline SplineVotes ReferenceVotes(const GestaltParams& params, const GoodnessGrid& grid,
                                  const messages::PoseEstimate& start, double curvature_per_m,
                                  const messages::Goal& goal) {
  const GestaltSplineParams& p = params.splines;
  const auto knot = [&p](std::int64_t i, std::int64_t count) {
    if (count == 1) return 0.0;
    return p.max_curvature_per_m *
           (static_cast<double>(2 * i - (count - 1)) / static_cast<double>(count - 1));
  };
  SplineVotes votes;
  for (std::int64_t i = 0; i < p.num_first_knots; ++i) {
    for (std::int64_t j = 0; j < p.num_second_knots; ++j) {
      votes.push_back(ReferenceVote(
          params, grid, start, goal,
          {curvature_per_m, knot(i, p.num_first_knots), knot(j, p.num_second_knots), p.length_m}));
    }
  }
  return votes;
}

}  // namespace rockyard::navigation
