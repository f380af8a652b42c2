// What a viewing ray meets, what shades it, and what a lamp reaches: for images line by line, which
// the light stripe sensor takes. Pictures of the terrain have picture/picture_scene.h, with the
// same SurfacePoint. Records of drives by such images depend on its bits.
#pragma once

#include <span>
#include <vector>

#include "math/pose.h"
#include "rendering/radiometry.h"
#include "rendering/rover_body.h"
#include "rendering/sun_params.h"
#include "terrain/rock.h"
#include "terrain/terrain.h"

namespace rockyard::rendering {

// The point that a viewing ray meets first.
struct SurfacePoint {
  // `surface` is the index of a rock, or one of these.
  static constexpr int kGround = -1;
  static constexpr int kWall = -2;
  static constexpr int kSky = -3;
  static constexpr int kRover = -4;

  math::Vector3 p_W = math::Vector3::Zero();
  math::Vector3 normal_W = math::Vector3::UnitZ();
  int surface = kSky;
  double albedo = 0.0;
  double radiance_w_m2_sr = 0.0;  // of sunlight within the passband

  // Lamps light the terrain; on the rover's own parts their light is left out.
  bool TakesLampLight() const { return surface >= kWall; }
};

// Returns whether one surface goes on from point to point: both lie on the same surface, and the
// chord between them lies nearly in its tangent planes.
bool IsOneSurface(const SurfacePoint& a, const SurfacePoint& b);

// A ball around some points, in W.
struct Ball {
  math::Vector3 center_W = math::Vector3::Zero();
  double radius_m = 0.0;
};

// The terrain, the sunlight and the rover's own body as the cameras meet them at one pose. Rocks
// farther from the rover's origin than sight_m are not seen; their shadows are, within that
// distance. All members are pure queries. Lists of rocks hold all that rays may meet and some more:
// they decide time alone. Terrain, body and sun must outlive the scene.
class ImageScene {
 public:
  ImageScene(const terrain::Terrain& terrain, const math::Transform& X_WR, const SunLight& light,
             const SunParams& sun, const RoverBody& body, double sight_m);

  double sight_m() const { return sight_m_; }
  const math::Transform& X_WR() const { return X_WR_; }

  // Lists the rocks of which a part may lie near the plane through an eye: where |normal_W . (p -
  // eye)| <= sine |p - eye|.
  void RocksNearPlane(const math::Vector3& eye_W, const math::Vector3& normal_W, double sine,
                      std::vector<int>& out) const;
  // Lists those of the given rocks whose bounding ball may meet the cone from an eye about axis_W
  // (unit).
  void RocksInCone(const math::Vector3& eye_W, const math::Vector3& axis_W, double half_sine,
                   double half_cosine, std::span<const int> among, std::vector<int>& out) const;
  // Lists the rocks that reach into the sheet of width_m on both sides of a plane.
  void RocksInSheet(const math::Vector3& p_W, const math::Vector3& normal_W, double width_m,
                    std::vector<int>& out) const;
  // Lists the rocks that may come between the sun and a ball, among all rocks or among an earlier
  // result, for Light. The numbers listed are the scene's own, no indices of the terrain.
  void RocksBeforeSun(const Ball& ball, std::vector<int>& out) const;
  void RocksBeforeSun(const Ball& ball, std::span<const int> among, std::vector<int>& out) const;

  // Returns what the unit ray from an eye meets first: ground, walls, the given rocks, or at body_m
  // the rover's own part. The sunlight of the point is not set.
  SurfacePoint Meet(const math::Vector3& eye_W, const math::Vector3& ray_W, double body_m,
                    std::span<const int> rocks) const;

  // Sets the sunlight that a point sends back, in the shadow of the given rocks (RocksBeforeSun),
  // of the ground and of the rover. Walls cast no shadow: they stand for the bounds of the arena.
  void Light(std::span<const int> shading, SurfacePoint& point) const;

  // Returns whether the light of a lamp reaches a point: neither the ground, the walls, the given
  // rocks nor the rover are between.
  bool Reaches(const math::Vector3& lamp_W, const math::Vector3& p_W,
               std::span<const int> rocks) const;

 private:
  bool Sunlit(const SurfacePoint& point, std::span<const int> shading) const;
  bool InRoversShadow(const math::Vector3& p_W) const;
  SurfacePoint MeetRover(const math::Vector3& eye_W, const math::Vector3& ray_W,
                         double body_m) const;

  const terrain::Terrain& terrain_;
  const RoverBody& body_;
  double sight_m_;
  math::Transform X_WR_;
  math::Transform X_RW_;
  SunLight light_;
  const SunParams& sun_;
  math::Vector3 toward_sun_R_;
  math::Vector3 body_center_W_;
  std::vector<int> near_;                   // within sight
  std::vector<int> before_sun_;             // may shade something within sight
  std::vector<terrain::RockShape> shapes_;  // of before_sun_, by place in it
};

}  // namespace rockyard::rendering
