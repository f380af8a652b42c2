#include "terrain/terrain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/check.h"

namespace rockyard::terrain {
namespace {

// Cells decide time and memory alone: queries look at every rock that a cell lists.
constexpr double kSmallestGridCell_m = 0.25;
// Bounds the grid's memory for wide, sparse fields: the cells grow instead.
constexpr double kMaxGridCells = 250000.0;

// Returns the radius of the circle around the outline seen from above.
double FootprintRadius(const Rock& rock) {
  return std::max(rock.semi_axes_m.x(), rock.semi_axes_m.y());
}

// Walks the cells of a uniform grid that a ray crosses (Amanatides and Woo 1987), one axis.
struct AxisWalk {
  int cell;
  int step;
  double next;   // ray distance at which the next cell begins
  double delta;  // ray distance across one cell

  AxisWalk(double position, double direction, double cell_size, int cells)
      : cell(std::clamp(static_cast<int>(std::floor(position / cell_size)), 0, cells - 1)),
        step(direction > 0.0 ? 1 : -1) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const double border = cell_size * (direction > 0.0 ? cell + 1 : cell);
    next = direction == 0.0 ? kNever : (border - position) / direction;
    delta = direction == 0.0 ? kNever : cell_size / std::abs(direction);
  }
  void Advance() {
    cell += step;
    next += delta;
  }
};

// Shrinks [enter, leave] to where a ray is within [0, extent]. Returns false where nothing is left.
bool ClipToSlab(double position, double direction, double extent, double& enter, double& leave) {
  if (direction == 0.0) return position >= 0.0 && position <= extent;
  // Ray parameters at both planes of the slab.
  const double a = -position / direction;
  const double b = (extent - position) / direction;
  enter = std::max(enter, std::min(a, b));
  leave = std::min(leave, std::max(a, b));
  return enter <= leave;
}

// What is left between two points when both ends are shortened by a margin.
struct Segment {
  math::Vector3 origin_W;
  math::Vector3 direction_W;
  double length_m;

  // Returns nothing where the margins leave no segment.
  static std::optional<Segment> Between(const math::Vector3& from_W, const math::Vector3& to_W,
                                        double margin_m) {
    const double distance_m = (to_W - from_W).norm();
    const double length_m = distance_m - 2.0 * margin_m;
    if (!(length_m > 0.0)) return std::nullopt;
    const math::Vector3 direction_W = (to_W - from_W) / distance_m;
    return Segment{from_W + margin_m * direction_W, direction_W, length_m};
  }
};

}  // namespace

Terrain::Terrain(Ground ground, std::vector<Rock> rocks, std::vector<Wall> walls)
    : ground_(std::move(ground)), rocks_(std::move(rocks)), walls_(std::move(walls)) {
  shapes_.reserve(rocks_.size());
  for (const Rock& rock : rocks_) {
    EXPECT(rock.semi_axes_m.minCoeff() > 0.0);
    // The map of each ellipsoid onto the unit sphere is worked out once.
    shapes_.emplace_back(rock);
  }
  BuildGrid();
}

void Terrain::MoveRock(int index, double dx_m, double dy_m) {
  EXPECT(index >= 0 && static_cast<std::size_t>(index) < rocks_.size());
  Rock& rock = rocks_[static_cast<std::size_t>(index)];
  math::Vector3& p_W = rock.center_W;
  const double above_ground_m = p_W.z() - ground_.Height(p_W.x(), p_W.y());
  p_W.head<2>() += Eigen::Vector2d(dx_m, dy_m);
  // The centre keeps its height over the ground beneath it: constant burial.
  p_W.z() = ground_.Height(p_W.x(), p_W.y()) + above_ground_m;
  shapes_[static_cast<std::size_t>(index)] = RockShape(rock);
  BuildGrid();
}

void Terrain::BuildGrid() {
  if (rocks_.empty()) return;
  Eigen::Array2d low = rocks_.front().center_W.head<2>().array();
  Eigen::Array2d high = low;
  for (const Rock& rock : rocks_) {
    const Eigen::Array2d center = rock.center_W.head<2>().array();
    low = low.min(center - FootprintRadius(rock));
    high = high.max(center + FootprintRadius(rock));
  }
  const Eigen::Array2d extent = high - low;
  // Square cells; fields that would need more than kMaxGridCells get larger ones.
  cell_m_ = std::max(kSmallestGridCell_m, std::sqrt(extent.prod() / kMaxGridCells));
  cells_per_m_ = 1.0 / cell_m_;
  grid_x0_m_ = low.x();
  grid_y0_m_ = low.y();
  grid_nx_ = static_cast<int>(extent.x() / cell_m_) + 1;
  grid_ny_ = static_cast<int>(extent.y() / cell_m_) + 1;

  // Counting sort of (cell, rock) pairs; rocks stay ascending within a cell.
  cell_start_.assign(static_cast<std::size_t>(grid_nx_) * grid_ny_ + 1, 0);
  const auto for_each_cell = [this](const Rock& rock, auto&& action) {
    const CellRange cells = CellsOf(rock.center_W.x(), rock.center_W.y(), FootprintRadius(rock));
    for (int iy = cells.first_y; iy <= cells.last_y; ++iy) {
      for (int ix = cells.first_x; ix <= cells.last_x; ++ix) {
        action(static_cast<std::size_t>(iy) * grid_nx_ + ix);
      }
    }
  };
  first_cells_.clear();
  for (const Rock& rock : rocks_) {
    const CellRange cells = CellsOf(rock.center_W.x(), rock.center_W.y(), FootprintRadius(rock));
    first_cells_.push_back({cells.first_x, cells.first_y});
    for_each_cell(rock, [this](std::size_t cell) { ++cell_start_[cell + 1]; });
  }
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  cell_rocks_.resize(static_cast<std::size_t>(cell_start_.back()));
  std::vector<int> fill(cell_start_.begin(), cell_start_.end() - 1);
  for (std::size_t i = 0; i < rocks_.size(); ++i) {
    for_each_cell(rocks_[i], [&](std::size_t cell) {
      cell_rocks_[static_cast<std::size_t>(fill[cell]++)] = static_cast<int>(i);
    });
  }
}

Terrain::CellRange Terrain::CellsOf(double x_m, double y_m, double radius_m) const {
  // Clamped as doubles first, so that far points cannot overflow the conversion.
  const auto index = [this](double offset_m, int cells) {
    return static_cast<int>(std::clamp(std::floor(offset_m * cells_per_m_), -1.0, double(cells)));
  };
  const double dx = x_m - grid_x0_m_;
  const double dy = y_m - grid_y0_m_;
  return {std::max(index(dx - radius_m, grid_nx_), 0),
          std::min(index(dx + radius_m, grid_nx_), grid_nx_ - 1),
          std::max(index(dy - radius_m, grid_ny_), 0),
          std::min(index(dy + radius_m, grid_ny_), grid_ny_ - 1)};
}

void Terrain::RocksNear(double x_m, double y_m, double radius_m, std::vector<int>& out) const {
  out.clear();
  const CellRange cells = CellsOf(x_m, y_m, radius_m);
  for (int iy = cells.first_y; iy <= cells.last_y; ++iy) {
    for (int ix = cells.first_x; ix <= cells.last_x; ++ix) {
      for (const int index : RocksOfCell(ix, iy)) {
        const auto at = static_cast<std::size_t>(index);
        // A rock stands in every cell that its box touches: it is taken in the first of them.
        if (ix != std::max(cells.first_x, first_cells_[at].x)) continue;
        if (iy != std::max(cells.first_y, first_cells_[at].y)) continue;
        const Rock& rock = rocks_[at];
        const double dx = rock.center_W.x() - x_m;
        const double dy = rock.center_W.y() - y_m;
        // Both discs meet: a superset, since outlines are ellipses.
        const double reach = radius_m + FootprintRadius(rock);
        if (dx * dx + dy * dy <= reach * reach) out.push_back(index);
      }
    }
  }
  std::sort(out.begin(), out.end());
}

// Walls come first, then the ground no farther than the nearest wall.
Terrain::Nearest Terrain::MeetBackground(const math::Vector3& origin_W,
                                         const math::Vector3& direction_W, double max_distance_m,
                                         RayWay way) const {
  Nearest nearest{max_distance_m, std::nullopt};
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    // A wall is met from inside only, n . d > 0, at the distance (offset - n . o) / (n . d). Both
    // are compared as a product first, so that rays along a wall divide nothing by zero.
    const double speed = walls_[i].normal_W.dot(direction_W);
    const double inside = walls_[i].offset_m - walls_[i].normal_W.dot(origin_W);
    if (speed > 0.0 && inside >= 0.0 && inside <= speed * nearest.distance_m) {
      nearest = {inside / speed, Surface::kWall, static_cast<int>(i)};
    }
  }
  if (const auto distance = ground_.CastRay(origin_W, direction_W, nearest.distance_m, way)) {
    nearest = {*distance, Surface::kGround};
  }
  return nearest;
}

void Terrain::MeetRocks(std::span<const int> rocks, const math::Vector3& origin_W,
                        const math::Vector3& direction_W, Nearest& nearest) const {
  for (const int rock : rocks) {
    const double distance = shapes_[static_cast<std::size_t>(rock)].Distance(origin_W, direction_W);
    // Of equally near rocks the first must stay, and ground or wall before any rock.
    if (distance < nearest.distance_m) nearest = {distance, Surface::kRock, rock};
  }
}

void Terrain::MeetRocksOnGrid(const math::Vector3& origin_W, const math::Vector3& direction_W,
                              Nearest& nearest) const {
  const double px = origin_W.x() - grid_x0_m_;
  const double py = origin_W.y() - grid_y0_m_;
  double enter = 0.0;
  // Ray parameters between which the ray is over the grid.
  double leave = nearest.distance_m;
  if (grid_nx_ == 0 || !ClipToSlab(px, direction_W.x(), grid_nx_ * cell_m_, enter, leave) ||
      !ClipToSlab(py, direction_W.y(), grid_ny_ * cell_m_, enter, leave)) {
    return;
  }
  AxisWalk x(px + enter * direction_W.x(), direction_W.x(), cell_m_, grid_nx_);
  AxisWalk y(py + enter * direction_W.y(), direction_W.y(), cell_m_, grid_ny_);
  while (x.cell >= 0 && x.cell < grid_nx_ && y.cell >= 0 && y.cell < grid_ny_) {
    MeetRocks(RocksOfCell(x.cell, y.cell), origin_W, direction_W, nearest);
    // The walk goes on to the neighbouring cell whose border comes first, no farther than to the
    // nearest surface so far.
    AxisWalk& axis = x.next < y.next ? x : y;
    if (enter + axis.next > std::min(nearest.distance_m, leave)) return;
    axis.Advance();
  }
}

std::optional<RayHit> Terrain::MakeHit(const math::Vector3& origin_W,
                                       const math::Vector3& direction_W, const Nearest& nearest,
                                       RayWay way) const {
  if (!nearest.surface) return std::nullopt;
  RayHit hit;
  hit.distance_m = nearest.distance_m;
  hit.point_W = origin_W + nearest.distance_m * direction_W;
  hit.surface = *nearest.surface;
  const auto index = static_cast<std::size_t>(nearest.index);
  if (hit.surface == Surface::kRock) hit.rock = nearest.index;
  // The ray starts inside a rock or below the ground, where there is no surface to have a normal.
  if (hit.distance_m == 0.0) {
    hit.normal_W = -direction_W;
  } else if (hit.surface == Surface::kRock) {
    hit.normal_W = shapes_[index].Normal(hit.point_W);
  } else if (hit.surface == Surface::kWall) {
    hit.normal_W = -walls_[index].normal_W;
  } else {
    hit.normal_W = ground_.Normal(hit.point_W.x(), hit.point_W.y(), way);
  }
  return hit;
}

std::optional<RayHit> Terrain::CastRay(const math::Vector3& origin_W,
                                       const math::Vector3& direction_W,
                                       double max_distance_m) const {
  EXPECT(std::abs(direction_W.squaredNorm() - 1.0) < 1e-9);
  Nearest nearest = MeetBackground(origin_W, direction_W, max_distance_m);
  MeetRocksOnGrid(origin_W, direction_W, nearest);
  return MakeHit(origin_W, direction_W, nearest);
}

std::optional<RayHit> Terrain::CastRay(const math::Vector3& origin_W,
                                       const math::Vector3& direction_W, double max_distance_m,
                                       std::span<const int> rocks, RayWay way) const {
  EXPECT(std::abs(direction_W.squaredNorm() - 1.0) < 1e-9);
  Nearest nearest = MeetBackground(origin_W, direction_W, max_distance_m, way);
  MeetRocks(rocks, origin_W, direction_W, nearest);
  return MakeHit(origin_W, direction_W, nearest, way);
}

std::optional<double> Terrain::RayDistance(const math::Vector3& origin_W,
                                           const math::Vector3& direction_W, double max_distance_m,
                                           std::span<const int> rocks) const {
  EXPECT(std::abs(direction_W.squaredNorm() - 1.0) < 1e-9);
  Nearest nearest = MeetBackground(origin_W, direction_W, max_distance_m);
  MeetRocks(rocks, origin_W, direction_W, nearest);
  if (!nearest.surface) return std::nullopt;
  return nearest.distance_m;
}

bool Terrain::Occluded(const math::Vector3& from_W, const math::Vector3& to_W,
                       double margin_m) const {
  const std::optional<Segment> segment = Segment::Between(from_W, to_W, margin_m);
  if (!segment) return false;
  Nearest nearest = MeetBackground(segment->origin_W, segment->direction_W, segment->length_m);
  // One surface is enough: rocks are asked only where walls and ground hide nothing.
  if (!nearest.surface) MeetRocksOnGrid(segment->origin_W, segment->direction_W, nearest);
  return nearest.surface.has_value();
}

bool Terrain::Occluded(const math::Vector3& from_W, const math::Vector3& to_W, double margin_m,
                       std::span<const int> rocks) const {
  const std::optional<Segment> segment = Segment::Between(from_W, to_W, margin_m);
  if (!segment) return false;
  Nearest nearest = MeetBackground(segment->origin_W, segment->direction_W, segment->length_m);
  if (!nearest.surface) MeetRocks(rocks, segment->origin_W, segment->direction_W, nearest);
  return nearest.surface.has_value();
}

}  // namespace rockyard::terrain
