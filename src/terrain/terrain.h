// A queryable piece of Mars (or of a test arena): ground, rocks, walls. One per trial. Every query
// is const and thread-safe; only MoveRock changes anything.
//
// Physics, sensors, pictures and the experimenter's counts must ask this one geometry, so that the
// rover meets what it sees. Code that works out a query in another way, as the stereo sensor does,
// is held to CastRay by a test. A rock's index names it all through a trial, in contacts, too.
// Records of all drives depend on the bits of queries and on ties: the ground goes before a wall,
// either before a rock, of rocks the one that is asked first.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "math/pose.h"
#include "terrain/ground.h"
#include "terrain/rock.h"

namespace rockyard::terrain {

enum class Surface { kGround, kRock, kWall };

// What a ray meets first.
struct RayHit {
  double distance_m = 0.0;  // along the unit ray
  math::Vector3 point_W = math::Vector3::Zero();
  math::Vector3 normal_W = math::Vector3::UnitZ();  // outward, unit
  Surface surface = Surface::kGround;
  int rock = -1;  // index in rocks() where surface == kRock
};

// A vertical plane that bounds the arena: points with normal . p < offset are inside. Rays meet it
// from inside only, at any height.
struct Wall {
  math::Vector3 normal_W = math::Vector3::UnitY();  // horizontal, pointing out of the arena
  double offset_m = 0.0;
};

// The ground, rocks and walls of one trial. Positions, directions and normals are in W, m.
class Terrain {
 public:
  Terrain(Ground ground, std::vector<Rock> rocks, std::vector<Wall> walls);

  const Ground& ground() const { return ground_; }
  std::span<const Rock> rocks() const { return rocks_; }
  std::span<const Wall> walls() const { return walls_; }

  // Slides a rock by (dx, dy); its centre keeps its height above the ground. Nothing stops the
  // rock: rocks may come to overlap one another or a wall, and mirror images stay. Every query sees
  // the rock at its new place; indices stay. Cost: that of building the grid, once for each call.
  void MoveRock(int index, double dx_m, double dy_m);

  // Returns the height of the highest surface (ground or rock top) above (x, y), m.
  double Height(double x_m, double y_m) const {
    double height = ground_.Height(x_m, y_m);
    for (const int rock : RocksAt(x_m, y_m)) {
      height = std::max(height, shapes_[static_cast<std::size_t>(rock)].Top(x_m, y_m));
    }
    return height;
  }

  // Lists the rocks that may reach into the disc around (x, y): indices of a superset, from a
  // uniform grid, without duplicates. `out` is cleared first. The order must stay ascending:
  // physics finds the contacts of the step before again by it.
  void RocksNear(double x_m, double y_m, double radius_m, std::vector<int>& out) const;

  // Returns the first surface that the ray from origin_W along the unit vector direction_W meets
  // within max_distance_m. What lies below the ground is never met. A ray that starts inside a rock
  // or below the ground meets it at distance 0, with the normal against the ray.
  std::optional<RayHit> CastRay(const math::Vector3& origin_W, const math::Vector3& direction_W,
                                double max_distance_m) const;

  // Does the same against the given rocks only: gather them once with RocksNear for many short
  // rays. `way` says how the ray finds rough ground (ground.h).
  std::optional<RayHit> CastRay(const math::Vector3& origin_W, const math::Vector3& direction_W,
                                double max_distance_m, std::span<const int> rocks,
                                RayWay way = RayWay::kMarch) const;

  // Returns the distance_m of CastRay with the same arguments, at half its cost.
  std::optional<double> RayDistance(const math::Vector3& origin_W, const math::Vector3& direction_W,
                                    double max_distance_m, std::span<const int> rocks) const;

  // Returns whether ground, a rock or a wall lies between the two points: on the segment that is
  // left when both ends are shortened by margin_m.
  bool Occluded(const math::Vector3& from_W, const math::Vector3& to_W, double margin_m) const;
  // Does the same against the given rocks only.
  bool Occluded(const math::Vector3& from_W, const math::Vector3& to_W, double margin_m,
                std::span<const int> rocks) const;

 private:
  // The nearest surface that a ray has been found to meet so far.
  struct Nearest {
    double distance_m = 0.0;
    std::optional<Surface> surface;
    int index = -1;  // of the rock or wall
  };
  struct CellRange {  // inclusive; empty where first > last
    int first_x, last_x, first_y, last_y;
  };

  void BuildGrid();
  CellRange CellsOf(double x_m, double y_m, double radius_m) const;
  std::span<const int> RocksOfCell(int ix, int iy) const {
    const std::size_t cell = static_cast<std::size_t>(iy) * grid_nx_ + ix;
    const int* first = cell_rocks_.data();
    return {first + cell_start_[cell], first + cell_start_[cell + 1]};
  }
  // Returns the rocks of the cell that holds (x, y); none beyond the grid.
  std::span<const int> RocksAt(double x_m, double y_m) const {
    const double column = (x_m - grid_x0_m_) * cells_per_m_;
    const double row = (y_m - grid_y0_m_) * cells_per_m_;
    // Written so that a coordinate that is not a number has no cell.
    if (!(column >= 0.0 && column < grid_nx_ && row >= 0.0 && row < grid_ny_)) return {};
    return RocksOfCell(static_cast<int>(column), static_cast<int>(row));
  }

  // Returns the nearest wall or ground within max_distance_m.
  Nearest MeetBackground(const math::Vector3& origin_W, const math::Vector3& direction_W,
                         double max_distance_m, RayWay way = RayWay::kMarch) const;
  // Replace `nearest` by a nearer rock: one of the given rocks, or of the cells along the ray.
  void MeetRocks(std::span<const int> rocks, const math::Vector3& origin_W,
                 const math::Vector3& direction_W, Nearest& nearest) const;
  void MeetRocksOnGrid(const math::Vector3& origin_W, const math::Vector3& direction_W,
                       Nearest& nearest) const;
  std::optional<RayHit> MakeHit(const math::Vector3& origin_W, const math::Vector3& direction_W,
                                const Nearest& nearest, RayWay way = RayWay::kMarch) const;

  Ground ground_;
  std::vector<Rock> rocks_;
  std::vector<RockShape> shapes_;
  std::vector<Wall> walls_;
  // Uniform grid over the rocks' bounding box: rocks of cell c are
  // cell_rocks_[cell_start_[c] .. cell_start_[c + 1]).
  double cell_m_ = 0.25;
  double cells_per_m_ = 4.0;
  double grid_x0_m_ = 0.0;
  double grid_y0_m_ = 0.0;
  int grid_nx_ = 0;
  int grid_ny_ = 0;
  std::vector<int> cell_start_;
  std::vector<int> cell_rocks_;
  // The cell with the least column and row of those that each rock stands in.
  struct GridCell {
    int x, y;
  };
  std::vector<GridCell> first_cells_;
};

}  // namespace rockyard::terrain
