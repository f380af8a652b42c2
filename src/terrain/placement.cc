#include "terrain/placement.h"

#include <algorithm>
#include <cmath>

namespace rockyard::terrain {
namespace {

constexpr double kSmallestCell_m = 0.5;
// Bounds the memory for wide, sparse fields: the cells grow instead.
constexpr double kMaxCells = 250000.0;

bool Overlap(const Disc& a, const Disc& b) {
  // |c_a - c_b| < r_a + r_b; discs that touch do not overlap.
  const double dx = a.x_m - b.x_m;
  const double dy = a.y_m - b.y_m;
  const double reach = a.radius_m + b.radius_m;
  return dx * dx + dy * dy < reach * reach;
}

}  // namespace

Placement::Placement(const Rectangle& layout, const Course& course, double clear_radius_m,
                     std::optional<double> line_to_keep_off_m)
    : layout_(layout),
      points_(course.Points()),
      clear_radius_m_(clear_radius_m),
      line_to_keep_off_m_(line_to_keep_off_m),
      cell_m_(std::max(kSmallestCell_m, std::sqrt(layout.Area() / kMaxCells))),
      nx_(static_cast<int>((layout.x_max_m - layout.x_min_m) / cell_m_) + 1),
      ny_(static_cast<int>((layout.y_max_m - layout.y_min_m) / cell_m_) + 1),
      cells_(static_cast<std::size_t>(nx_) * ny_) {}

// Clear zones are discs around the points of the course, and rocks keep out with their whole
// outline.
bool Placement::ClearOfCourse(const Disc& disc) const {
  return std::none_of(points_.begin(), points_.end(), [&](const CoursePoint& point) {
    return Overlap(disc, {point.x_m, point.y_m, clear_radius_m_});
  });
}

// Discs beyond the layout go to its border cells, both when added and when asked for.
Placement::Cells Placement::CellsOf(const Disc& disc) const {
  const auto index = [this](double offset_m, int cells) {
    return std::clamp(static_cast<int>(std::floor(offset_m / cell_m_)), 0, cells - 1);
  };
  const double dx = disc.x_m - layout_.x_min_m;
  const double dy = disc.y_m - layout_.y_min_m;
  return {index(dx - disc.radius_m, nx_), index(dx + disc.radius_m, nx_),
          index(dy - disc.radius_m, ny_), index(dy + disc.radius_m, ny_)};
}

bool Placement::Free(const Disc& disc) const {
  if (line_to_keep_off_m_ && std::abs(disc.y_m) + disc.radius_m > *line_to_keep_off_m_) {
    return false;
  }
  const Cells cells = CellsOf(disc);
  // Two discs that overlap share a cell of their bounding boxes, so looking into the disc's own
  // cells is enough.
  for (int iy = cells.first_y; iy <= cells.last_y; ++iy) {
    for (int ix = cells.first_x; ix <= cells.last_x; ++ix) {
      for (const Disc& other : cells_[static_cast<std::size_t>(iy) * nx_ + ix]) {
        if (Overlap(disc, other)) return false;
      }
    }
  }
  return true;
}

// In every cell that its bounding box touches.
void Placement::Add(const Disc& disc) {
  const Cells cells = CellsOf(disc);
  for (int iy = cells.first_y; iy <= cells.last_y; ++iy) {
    for (int ix = cells.first_x; ix <= cells.last_x; ++ix) {
      cells_[static_cast<std::size_t>(iy) * nx_ + ix].push_back(disc);
    }
  }
}

}  // namespace rockyard::terrain
