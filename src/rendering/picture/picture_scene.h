// The terrain, the sunlight and the rover as any camera meets them at one moment: what the pictures
// of the stereo cameras, and their true disparities, ask. Records of drives by these pictures
// depend on the bits of Meet and Radiance; no drive asks Hides.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "rendering/image_scene.h"
#include "rendering/occlusion.h"
#include "rendering/picture/picture_params.h"
#include "rendering/picture/sun_shadows.h"
#include "rendering/radiometry.h"
#include "rendering/sun_params.h"
#include "terrain/terrain.h"

namespace rockyard::rendering {

// What a ray met, and how far from its origin.
struct Met {
  SurfacePoint point;
  double range_m = 0.0;
  double sunlit = 0.0;  // share of the sun's disc that the point sees
};

// Answers pure queries, from any thread. The terrain and the rover's body have to outlive the
// scene. A scene must be built anew where a rock, the rover or the sun moves: about 0.1 ms for each
// hundred rocks.
class PictureScene {
 public:
  // Rays end at this distance: beyond is the sky.
  static constexpr double kFarthest_m = 200.0;

  PictureScene(const terrain::Terrain& terrain, const SunParams& sun, const LookParams& look,
               double filter_width_m, const PlacedBody& rover);

  const terrain::Terrain& terrain() const { return terrain_; }
  const SunLight& light() const { return light_; }
  const PlacedBody& rover() const { return rover_; }

  // Lists, ascending, the rocks that a ray may meet whose origin lies within spread_m of eye_W and
  // whose direction lies in the cone: the candidates of Meet.
  void RocksInCone(const math::Vector3& eye_W, double spread_m, const RayCone& cone_W,
                   std::vector<int>& out) const;
  // Does the same among the given rocks only.
  void RocksInCone(const math::Vector3& eye_W, double spread_m, const RayCone& cone_W,
                   std::span<const int> among, std::vector<int>& out) const;

  // Returns what the unit ray meets first, with its share of the sun: what Terrain::CastRay gives,
  // or one of the rover's own parts. The point must have the bits of Terrain::CastRay; over rough
  // ground it lies within 1e-9 m (RayWay::kSpline).
  Met Meet(const math::Vector3& origin_W, const math::Vector3& ray_W,
           std::span<const int> rocks) const;

  // Returns whether the terrain or the rover lies between a point of a surface and an eye. Terrain
  // nearer to either of them than kOcclusionMargin_m does not count, nor the rover that near to the
  // point.
  bool Hides(const math::Vector3& p_W, const math::Vector3& eye_W) const;

  // Returns the radiance of a point that is seen along ray_W, given how it looks:
  //   L = A/pi (E_direct v f(mu0, mu) + E_sky (1 + n_z) / 2),
  //   f = (1 - S) mu0 + S 2 mu0 / (mu0 + mu)
  // with the share v of the sun, mu0 = n.s, mu = -n.ray, and the share S of Lommel and Seeliger
  // (the lunar-Lambert law, McEwen 1991; S = 0 is Lambert's). The sky is even: E_sky / pi.
  double Radiance(const Met& met, const math::Vector3& ray_W, double albedo,
                  const math::Vector3& normal_W) const;

 private:
  bool MayBeIn(int rock, const math::Vector3& eye_W, double spread_m, const RayCone& cone_W) const;

  const terrain::Terrain& terrain_;
  SunLight light_;
  double lommel_seeliger_share_;
  PlacedBody rover_;
  math::Transform X_RW_;
  std::optional<SunShadows> shadows_;  // none without direct light
};

}  // namespace rockyard::rendering
