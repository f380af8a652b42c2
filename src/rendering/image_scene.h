// What a viewing ray meets, what shades it, and what a lamp reaches: for images line by line, as of
// the light stripe sensor. Pictures of the terrain have picture/picture_scene.h.
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

// Returns whether a surface goes on from one point to the other: the same one, and the chord
// between them nearly in its tangent plane.
bool IsOneSurface(const SurfacePoint& a, const SurfacePoint& b);

// The terrain, the sunlight and the rover's own body as the cameras meet them at one pose.

// A ball around some points, in W.
struct Ball {
  math::Vector3 center_W = math::Vector3::Zero();
  double radius_m = 0.0;
};

// What the cameras can meet at one pose. Rocks farther from the rover's origin than sight_m are not
// seen, nor is what they shade. All members are pure queries; the scene must not outlive the
// terrain.
class ImageScene {
 public:
  ImageScene(const terrain::Terrain& terrain, const math::Transform& X_WR, const SunLight& light,
             const SunParams& sun, const RoverBody& body, double sight_m);

  double sight_m() const { return sight_m_; }
  const math::Transform& X_WR() const { return X_WR_; }

  // Lists the rocks of which a part may lie where |normal_W . (p - eye)| <= sine |p - eye|: about a
  // plane.
  void RocksNearPlane(const math::Vector3& eye_W, const math::Vector3& normal_W, double sine,
                      std::vector<int>& out) const;
  // Lists, of the given rocks, those whose bounding ball meets the cone from an eye about axis_W
  // (unit).
  void RocksInCone(const math::Vector3& eye_W, const math::Vector3& axis_W, double half_sine,
                   double half_cosine, std::span<const int> among, std::vector<int>& out) const;
  // Lists the rocks that reach into the sheet of width_m on both sides of a plane.
  void RocksInSheet(const math::Vector3& p_W, const math::Vector3& normal_W, double width_m,
                    std::vector<int>& out) const;
  // Lists the rocks that may come between the sun and a ball, of all or of an earlier result: Light
  // asks for them.
  void RocksBeforeSun(const Ball& ball, std::vector<int>& out) const;
  void RocksBeforeSun(const Ball& ball, std::span<const int> among, std::vector<int>& out) const;

  // Returns what the unit ray from an eye meets first among the ground, the walls and the given
  // rocks, if that is nearer than body_m, where the rover's own part is. Its sunlight is not set.
  SurfacePoint Meet(const math::Vector3& eye_W, const math::Vector3& ray_W, double body_m,
                    std::span<const int> rocks) const;

  // Sets the sunlight that a point sends back, in the shadow of the given rocks (RocksBeforeSun),
  // of the ground and of the rover. Walls cast none: they stand for the bounds of the arena.
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
