// A queryable piece of Mars (or of a test arena): ground, rocks, walls. Immutable once built, one per
// trial; every query is const and thread-safe.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "math/pose.h"
#include "terrain/ground.h"
#include "terrain/rock.h"

namespace rockyard::terrain {

enum class Surface { kGround, kRock, kWall };

struct RayHit {
  double distance_m = 0.0;  // along the unit ray
  math::Vector3 point_W = math::Vector3::Zero();
  math::Vector3 normal_W = math::Vector3::UnitZ();  // outward, unit
  Surface surface = Surface::kGround;
  int rock = -1;  // index in rocks() where surface == kRock
};

// A vertical plane that bounds the arena: points with normal . p < offset are inside.
struct Wall {
  math::Vector3 normal_W = math::Vector3::UnitY();  // horizontal, pointing out of the arena
  double offset_m = 0.0;
};

class Terrain {
 public:
  Terrain(Ground ground, std::vector<Rock> rocks, std::vector<Wall> walls);

  const Ground& ground() const { return ground_; }
  std::span<const Rock> rocks() const { return rocks_; }
  std::span<const Wall> walls() const { return walls_; }

  // Height of the highest surface (ground or rock top) above (x, y), m.
  double Height(double x_m, double y_m) const;

  // Indices of the rocks that may reach into the disc around (x, y): a superset, ascending, no
  // duplicates, from a uniform grid. Appends nothing elsewhere: `out` is cleared first.
  void RocksNear(double x_m, double y_m, double radius_m, std::vector<int>& out) const;

  // First surface that the ray from origin_W along the unit vector direction_W meets within
  // max_distance_m.
  std::optional<RayHit> CastRay(const math::Vector3& origin_W, const math::Vector3& direction_W,
                                double max_distance_m) const;

  // True if anything lies strictly between the two points (both ends shortened by margin_m).
  bool Occluded(const math::Vector3& from_W, const math::Vector3& to_W, double margin_m) const;

 private:
  Ground ground_;
  std::vector<Rock> rocks_;
  std::vector<Wall> walls_;
  // Uniform grid over the rocks' bounding box: rocks of cell c are
  // cell_rocks_[cell_start_[c] .. cell_start_[c + 1]).
  double cell_m_ = 0.25;
  double grid_x0_m_ = 0.0;
  double grid_y0_m_ = 0.0;
  int grid_nx_ = 0;
  int grid_ny_ = 0;
  std::vector<int> cell_start_;
  std::vector<int> cell_rocks_;
};

}  // namespace rockyard::terrain
