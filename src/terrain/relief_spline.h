// The relief of the ground as one spline, cell by cell: an elevation model, roughness, or both.
// Ground on a model is asked through it alone; other rough ground is so for the many rays of
// pictures (RayWay::kSpline in ground.h). Records depend on its bits where there is a model, or
// where a drive takes pictures.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "terrain/elevation_model.h"
#include "terrain/relief.h"

namespace rockyard::terrain {

// A straight line over the relief, by the distance t along a ray: above (x, y) + t (along_x,
// along_y) at the height height_m - t descent.
struct SightLine {
  double x_m, y_m;
  double along_x, along_y;
  double height_m, descent;
};

// The sum of an elevation model and a RoughnessField, to rounding. A B-spline with the nodes c is
// also a B-spline on a lattice twice as fine, with the nodes U c, U = [1 4 6 4 1]/8 along each
// axis. So lattices that halve from one to the next are together one spline on the finest, C_j = U
// C_(j-1) + c_j. Nodes are worked out in pages where a query first comes, and kept: 110 kB and
// about 0.5 ms for 64 x 64 cells. Queries are pure and may come from any thread.
class ReliefSpline {
 public:
  // Either may be missing. With both, the model's cell over the spacing of the longest octave's
  // lattice must be a power of two.
  ReliefSpline(std::shared_ptr<const ElevationModel> model,
               std::shared_ptr<const RoughnessField> roughness);
  ~ReliefSpline();
  ReliefSpline(const ReliefSpline&) = delete;
  ReliefSpline& operator=(const ReliefSpline&) = delete;

  // Returns the model; nothing where there is none.
  const std::shared_ptr<const ElevationModel>& model() const { return model_; }
  // Returns upper bounds over all points.
  const ReliefBounds& bounds() const { return bounds_; }

  ReliefSample Sample(double x_m, double y_m) const;

  // Returns the first t, at most max_distance_m, at which the line is not above the surface. The
  // line visits the cells of the lattice one by one, and skips blocks of 8 x 8 cells that lie below
  // it. In each cell it is compared with the upper bound of the height. A part of the line that is
  // not above the bound is halved until bounds on the curvature tell, or until it is shorter than 1
  // mm: a crest cut over less than that can be missed.
  std::optional<double> FirstBelow(const SightLine& line, double max_distance_m) const;

 private:
  static constexpr int kPageShift = 6;
  static constexpr int kPage = 1 << kPageShift;  // cells along a page's side
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
  // The pages that are found without a lock, in the order of rows.
  struct Pages {
    std::int64_t first_column = 0, first_row = 0, columns = 0, rows = 0;
  };
  // Returns the sum of the lattices down to a level on one of its pages.
  Nodes NodesOf(int level, std::int64_t page_column, std::int64_t page_row) const;
  std::unique_ptr<Page> MakePage(std::int64_t column, std::int64_t row) const;
  Bounds BoundsOf(const Nodes& nodes_m, int column, int row) const;
  const Page& PageAt(std::int64_t page_column, std::int64_t page_row) const;
  Cell CellAt(std::int64_t column, std::int64_t row) const;
  ReliefSample SampleIn(const Cell& cell, double u, double v) const;

  const Page& FarPage(std::int64_t column, std::int64_t row) const;

  std::shared_ptr<const ElevationModel> model_;
  std::shared_ptr<const RoughnessField> roughness_;
  ReliefBounds bounds_;
  // Levels count lattices from the coarsest, 0, to the finest, each half as wide as the one before.
  int model_level_ = 0;
  int roughness_level_ = 0;  // of the longest octave
  int finest_ = 0;
  double cells_per_m_;
  Pages near_;
  mutable std::vector<std::atomic<const Page*>> pages_;
  // Pages beyond them: far beyond a model, where rays rarely come.
  mutable std::mutex far_mutex_;
  mutable std::map<std::pair<std::int64_t, std::int64_t>, std::unique_ptr<const Page>> far_pages_;
};

}  // namespace rockyard::terrain
