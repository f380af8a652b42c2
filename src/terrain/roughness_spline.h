// The roughness of the ground for the many rays of pictures (RayWay::kSpline in ground.h). Records
// depend on its bits only where a drive takes pictures: stereo or visual odometry by images.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "terrain/relief.h"

namespace rockyard::terrain {

// A straight line over the roughness, by the distance t along a ray: above (x, y) + t (along_x,
// along_y) at the height height_m - t descent.
struct SightLine {
  double x_m, y_m;
  double along_x, along_y;
  double height_m, descent;
};

// The surface of a RoughnessField, to rounding. A B-spline with the nodes c is also a B-spline on a
// lattice twice as fine, with the nodes U c, U = [1 4 6 4 1]/8 along each axis. So all octaves
// together are one spline on the lattice of the finest, C_j = U C_(j-1) + c_j. Nodes are worked out
// in pages where a ray first comes, and kept: 110 kB and about 0.5 ms for 64 x 64 cells. Queries
// are pure and may come from any thread.
class RoughnessSpline {
 public:
  explicit RoughnessSpline(std::shared_ptr<const RoughnessField> field);
  ~RoughnessSpline();
  RoughnessSpline(const RoughnessSpline&) = delete;
  RoughnessSpline& operator=(const RoughnessSpline&) = delete;

  ReliefSample Sample(double x_m, double y_m) const;

  // Returns the first t, at most max_distance_m, at which the line is not above the surface. The
  // line visits the cells of the lattice one by one, and skips blocks of 8 x 8 cells that lie below
  // it. In each cell it is compared with the upper bound of the height. A part of the line that is
  // not above the bound is halved until bounds on the curvature tell, or until it is shorter than 1
  // mm: a crest cut over less than that can be missed.
  std::optional<double> FirstBelow(const SightLine& line, double max_distance_m) const;

 private:
  static constexpr int kPage = 64;          // cells along a page's side
  static constexpr int kNodes = kPage + 3;  // splines centred on the nodes -1 to 65 reach into it
  using Nodes = std::vector<double>;        // kNodes x kNodes, row by row

  // Upper bounds over all points of a cell.
  struct Bounds {
    double height_m;
    double curvature_per_m;
  };
  static constexpr int kBlock = 8;  // cells along the side of a block
  struct Page {
    Nodes nodes_m;
    std::array<Bounds, std::size_t{kPage} * kPage> bounds{};
    std::array<double, std::size_t{kPage} * kPage / kBlock / kBlock> highest_m{};  // by block
  };
  // One cell of a page.
  struct Cell {
    const Page* page;
    int column, row;
  };

  static std::size_t PlaceOf(int column, int row) {
    return static_cast<std::size_t>(row) * kPage + static_cast<std::size_t>(column);
  }
  static std::size_t BlockOf(int column, int row) {
    const int blocks_below = row / kBlock * (kPage / kBlock);
    return static_cast<std::size_t>(blocks_below) + static_cast<std::size_t>(column / kBlock);
  }
  Nodes NodesOf(int octave, std::int64_t page_column, std::int64_t page_row) const;
  Bounds BoundsOf(const Nodes& nodes_m, int column, int row) const;
  const Page& PageAt(std::int64_t page_column, std::int64_t page_row) const;
  Cell CellAt(std::int64_t column, std::int64_t row) const;
  ReliefSample SampleIn(const Cell& cell, double u, double v) const;

  std::shared_ptr<const RoughnessField> field_;
  double cells_per_m_;
  int page_mask_;  // pages repeat after page_mask_ + 1, a power of two
  mutable std::vector<std::atomic<const Page*>> pages_;
};

}  // namespace rockyard::terrain
