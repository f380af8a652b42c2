// Where a part of an elevation file lies: a plane that touches the body at a place, east and north
// in metres, over the cells of the file. Crops and scans of sites go by it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "image_files/elevation_raster.h"

namespace rockyard::campaign {

// How the places of a file are told.
enum class SiteFrame {
  kGeographic,  // latitude and longitude, degrees
  kMap,         // x and y of the file, metres
};

// A place between the middles of cells: that of the first cell is 0, 0.
struct PixelPoint {
  double column = 0.0;
  double row = 0.0;
};

// Two numbers that tell a place, such as longitude and latitude, to x and y in the world, m: linear
// around the origin, off by a few centimetres at 500 m.
struct LinearPlaces {
  double first = 0.0;  // of the origin
  double second = 0.0;
  double x_first = 0.0, x_second = 0.0;  // metres per unit
  double y_first = 0.0, y_second = 0.0;

  std::array<double, 2> At(double a, double b) const {
    return {x_first * (a - first) + x_second * (b - second),
            y_first * (a - first) + y_second * (b - second)};
  }
  // Returns the direction of the first number's axis in the world.
  double TurnedRad() const;
};

class SitePlane {
 public:
  // `cell_m` is the side of a cell of a file that does not say where it lies; its map has its
  // origin in the middle of the last row's first cell. Throws core::UserError: a file that does not
  // say and no cell_m, or cell_m for one that does; a geographic frame that is asked for and not
  // there.
  SitePlane(const image_files::ElevationRaster& raster, std::optional<double> cell_m, bool by_map);

  SiteFrame frame() const { return frame_; }

  // Lays the plane to a place: latitude and longitude, or x and y.
  void Touch(const std::array<double, 2>& place);
  // Lays it to a place between cells.
  void TouchPixel(const PixelPoint& pixel);
  // Where it touches, by the same two numbers.
  const std::array<double, 2>& place() const { return place_; }
  // Returns that place for people.
  std::string PlaceText() const;
  // Returns that place as --at takes it.
  std::string PlaceOption() const;

  // Returns the places in cells of points of the plane.
  std::vector<PixelPoint> Pixels(std::span<const image_files::LocalPoint> points) const;

  // How the cells lie on the plane, around the place where it touches.
  struct Cells {
    double side_m = 0.0;   // of a square of the area of a cell
    bool aligned = false;  // rows along y, columns along x, squares: within 1e-3
    bool north_up = true;  // rows go south
    // Cells per metre: columns and rows to the east, then to the north.
    double columns_east = 0.0, rows_east = 0.0, columns_north = 0.0, rows_north = 0.0;
  };
  Cells CellsAt(double reach_m) const;

  // Return where x and y of the map, and longitude and latitude, lie in a world whose origin is at
  // that place between cells; the latter require a geographic frame.
  LinearPlaces FromMap(const PixelPoint& origin, double reach_m) const;
  LinearPlaces FromGeographic(const PixelPoint& origin, double reach_m) const;

 private:
  PixelPoint PixelOf(const image_files::MapPoint& point) const;
  image_files::MapPoint MapOf(const PixelPoint& pixel) const;
  // Returns the world's places of two numbers that `tell` gives for points of the map.
  template <typename Tell>
  LinearPlaces PlacesBy(const PixelPoint& origin, double reach_m, const Tell& tell) const;

  const image_files::ElevationRaster& raster_;
  SiteFrame frame_ = SiteFrame::kMap;
  std::array<double, 6> transform_{};
  std::array<double, 2> place_{};
};

}  // namespace rockyard::campaign
