#include "rendering/picture/pixel_rays.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/check.h"

namespace rockyard::rendering {

using math::Vector3;

PixelRays::PixelRays(const vision::CameraModel& camera)
    : columns_(camera.size.columns), rows_(camera.size.rows) {
  EXPECT(columns_ >= 2 && rows_ >= 2);
  const std::size_t pixels = static_cast<std::size_t>(columns_) * rows_;
  origins_A_.reserve(pixels);
  directions_A_.reserve(pixels);
  sees_.reserve(pixels);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const std::optional<vision::Ray> ray = BackProject(camera, vision::Pixel(column, row));
      sees_.push_back(ray ? 1 : 0);
      // A pixel without a ray is never asked for its direction: any will do.
      origins_A_.push_back(ray ? ray->origin : Vector3::Zero());
      directions_A_.push_back(ray ? ray->direction : Vector3::UnitX());
    }
  }
  MarkEdges();
  // Most lenses have one centre, the same to the last bit for all pixels.
  const auto first = std::find(sees_.begin(), sees_.end(), 1);
  EXPECT(first != sees_.end());
  const Vector3 origin_A = origins_A_[static_cast<std::size_t>(first - sees_.begin())];
  for (std::size_t i = 0; i < pixels; ++i) {
    one_origin_ = one_origin_ && (sees_[i] == 0 || origins_A_[i] == origin_A);
  }
  if (one_origin_) origins_A_.assign(1, origin_A);
  tiles_ = MakeTiles(kTile);
  blocks_ = MakeTiles(kTile * kTilesPerBlock);
}

std::vector<PixelRays::Tile> PixelRays::MakeTiles(int side) const {
  std::vector<Tile> tiles;
  for (int row = 0; row < rows_; row += side) {
    for (int column = 0; column < columns_; column += side) {
      tiles.push_back(MakeTile(column, row, side));
    }
  }
  return tiles;
}

PixelRays::Tile PixelRays::MakeTile(int first_column, int first_row, int side) const {
  Tile tile;
  double beside = 0.0;  // as a chord between unit vectors
  const auto for_each = [&](auto&& use) {
    for (int row = first_row; row < std::min(first_row + side, rows_); ++row) {
      for (int column = first_column; column < std::min(first_column + side, columns_); ++column) {
        if (Sees(column, row)) use(column, row, At(column, row));
      }
    }
  };
  Vector3 sum = Vector3::Zero();
  for_each([&](int, int, const vision::Ray& ray) {
    if (!tile.sees) tile.origin_A = ray.origin;
    tile.sees = true;
    sum += ray.direction;
  });
  if (!tile.sees) return tile;
  tile.cone.axis = sum.normalized();
  for_each([&](int column, int row, const vision::Ray& ray) {
    tile.origin_spread_m = std::max(tile.origin_spread_m, (ray.origin - tile.origin_A).norm());
    // Rays beside the middle lie within half a pixel each way.
    const double half_pixel = 0.5 * (ByColumn(column, row).norm() + ByRow(column, row).norm());
    beside = std::max(beside, (ray.direction - tile.cone.axis).norm() + half_pixel);
  });
  tile.cone = RayCone::Around(tile.cone.axis, beside);
  return tile;
}

// A pixel at the edge of what a lens sees has no known size: it is taken as blind.
void PixelRays::MarkEdges() {
  const std::vector<char> has_ray = sees_;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      bool all = true;
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows_ - 1); ++r) {
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, columns_ - 1); ++c) {
          all = all && has_ray[Index(c, r)] != 0;
        }
      }
      sees_[Index(column, row)] = all ? 1 : 0;
    }
  }
}

Vector3 PixelRays::ByColumn(int column, int row) const {
  const int left = std::max(column - 1, 0);
  const int right = std::min(column + 1, columns_ - 1);
  return (directions_A_[Index(right, row)] - directions_A_[Index(left, row)]) / (right - left);
}

Vector3 PixelRays::ByRow(int column, int row) const {
  const int above = std::max(row - 1, 0);
  const int below = std::min(row + 1, rows_ - 1);
  return (directions_A_[Index(column, below)] - directions_A_[Index(column, above)]) /
         (below - above);
}

}  // namespace rockyard::rendering
