// The viewing rays of a camera, worked out once: pictures are rendered and read out by them, and
// the masks of the rover's own parts are held against them. Records of drives by pictures depend on
// the bits of rays and derivatives.
#pragma once

#include <vector>

#include "math/pose.h"
#include "rendering/occlusion.h"
#include "vision/cameras/camera_model.h"

namespace rockyard::rendering {

// Rays through the middles of the pixels of an image and how they change from pixel to pixel, in
// the camera's outer frame A. Pixel (0, 0) is the upper left one, its middle at column 0 and row 0.
// Making one costs a ray of the camera for each pixel, and 50 bytes; it holds until the camera is
// calibrated anew.
class PixelRays {
 public:
  // The image must have 2 columns and 2 rows at least, and a pixel that sees.
  explicit PixelRays(const vision::CameraModel& camera);

  int columns() const { return columns_; }
  int rows() const { return rows_; }

  // Returns whether the pixel and all its neighbours have a ray, so that its size is known.
  bool Sees(int column, int row) const { return sees_[Index(column, row)]; }

  // Returns the ray of a pixel that sees.
  vision::Ray At(int column, int row) const {
    const std::size_t i = Index(column, row);
    return {one_origin_ ? origins_A_.front() : origins_A_[i], directions_A_[i]};
  }

  // Returns the ray beside the middle of a pixel, by shares of a column and of a row up to 1/2. It
  // follows the derivatives in the middle, as if they did not change within a pixel.
  vision::Ray Beside(int column, int row, double columns_right, double rows_down) const {
    vision::Ray ray = At(column, row);
    ray.direction =
        (ray.direction + columns_right * ByColumn(column, row) + rows_down * ByRow(column, row))
            .normalized();
    return ray;
  }

  // A Tile holds all rays through a square of pixels, with half a pixel around it. There are tiles
  // of kTile x kTile pixels, and blocks of kTilesPerBlock x kTilesPerBlock tiles. Their cones only
  // sift rocks, so that these sizes decide time alone.
  static constexpr int kTile = 8;
  static constexpr int kTilesPerBlock = 8;
  struct Tile {
    bool sees = false;  // any pixel does
    math::Vector3 origin_A = math::Vector3::Zero();
    double origin_spread_m = 0.0;  // how far from there other origins lie
    RayCone cone;
  };
  int tile_columns() const { return (columns_ + kTile - 1) / kTile; }
  int block_columns() const { return (tile_columns() + kTilesPerBlock - 1) / kTilesPerBlock; }
  const Tile& TileAt(int tile_column, int tile_row) const {
    return tiles_[static_cast<std::size_t>(tile_row) * tile_columns() + tile_column];
  }
  const Tile& BlockAt(int block_column, int block_row) const {
    return blocks_[static_cast<std::size_t>(block_row) * block_columns() + block_column];
  }

  // Return how the direction changes with a column and with a row: from the neighbours on both
  // sides, at an edge of the image from the pixel itself and its one neighbour.
  math::Vector3 ByColumn(int column, int row) const;
  math::Vector3 ByRow(int column, int row) const;

 private:
  std::size_t Index(int column, int row) const {
    return static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column);
  }
  void MarkEdges();
  Tile MakeTile(int first_column, int first_row, int side) const;
  std::vector<Tile> MakeTiles(int side) const;

  int columns_;
  int rows_;
  bool one_origin_ = true;
  std::vector<math::Vector3> origins_A_;  // one where all are the same
  std::vector<math::Vector3> directions_A_;
  std::vector<char> sees_;
  std::vector<Tile> tiles_;
  std::vector<Tile> blocks_;
};

}  // namespace rockyard::rendering
