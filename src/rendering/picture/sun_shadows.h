// How much of the sun a point sees, for pictures of the terrain. The error model of stereo has a
// simpler shade of its own (sensing/sun_shade.h), stripe images theirs in ImageScene. Records of
// drives by pictures depend on its bits, not on its grid.
#pragma once

#include <span>
#include <vector>

#include "math/pose.h"
#include "rendering/rover_body.h"
#include "terrain/terrain.h"

namespace rockyard::rendering {

// The rover among the shapes that cast shadows, and its pose.
struct PlacedBody {
  const RoverBody* body = nullptr;  // nullptr: no rover
  math::Transform X_WR = math::Transform::Identity();
};

// Shadows of rocks, of rough ground and of a rover under a sun that is a disc or a point. Rocks are
// seen along the sun's rays, sorted into a grid across the rays: there an ellipsoid is an ellipse
//   m(x - x0) = (x - x0)^T M (x - x0) = 1,   M = A^T P A,
// A its map onto the unit sphere, P the projection along the mapped ray. At the rock the sun's disc
// is as wide as diameter * distance. Where the edge of the ellipse runs through it, the disc is cut
// by a straight line at the distance (sqrt(m) - 1) / |grad sqrt(m)| from its middle. The shares
// that several rocks leave are multiplied. Caps (rock.h) are asked by eight rays over the disc,
// ground and rover by one: the shadows of these two have hard edges. Walls cast no shadow.
class SunShadows {
 public:
  // `toward_sun_W` is a unit vector with z > 0. Terrain and rover must outlive this.
  SunShadows(const terrain::Terrain& terrain, const math::Vector3& toward_sun_W,
             double sun_diameter_rad, const PlacedBody& rover);

  // Returns the share of the disc that a point of a surface sees, 0 to 1; `surface` as in
  // SurfacePoint. A surface that is turned away from the sun's middle sees nothing. Cost: 5 to 40
  // ns on a plane, some microseconds on other ground.
  double Visible(const math::Vector3& p_W, const math::Vector3& normal_W, int surface) const;

 private:
  // A rock as the sun sees it.
  struct Silhouette {
    int rock = -1;
    double x_m = 0.0, y_m = 0.0;          // of its centre, across the rays
    double xx = 0.0, xy = 0.0, yy = 0.0;  // M
    math::Vector3 center_W = math::Vector3::Zero();
    // q . e of a point is its dot product with the vector from the centre; negative where the rock
    // lies towards the sun.
    math::Vector3 along_per_m = math::Vector3::Zero();
    double speed2 = 0.0;  // |e|^2
    bool is_cap = false;
    double reach_m = 0.0;
  };

  void AddSilhouette(int rock);
  void BuildGrid();
  std::span<const int> CellAt(double x_m, double y_m) const;
  double LeftBy(const Silhouette& rock, const math::Vector3& p_W, double x_m, double y_m) const;
  double LeftByCap(const Silhouette& rock, const math::Vector3& p_W) const;
  bool InRoversShadow(const math::Vector3& p_W) const;

  const terrain::Terrain& terrain_;
  math::Vector3 toward_sun_W_;
  math::Vector3 across_x_W_;
  math::Vector3 across_y_W_;
  double half_diameter_rad_;
  PlacedBody rover_;
  math::Transform X_RW_;
  math::Vector3 toward_sun_R_;
  math::Vector3 rover_center_W_ = math::Vector3::Zero();

  std::vector<Silhouette> rocks_;
  std::vector<terrain::RockShape> shapes_;  // of rocks_
  double x0_m_ = 0.0;
  double y0_m_ = 0.0;
  double cells_per_m_ = 1.0;
  int cells_x_ = 0;
  int cells_y_ = 0;
  std::vector<int> cell_start_;
  std::vector<int> cell_rocks_;
};

}  // namespace rockyard::rendering
