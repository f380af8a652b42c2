// Albedo and fine relief of the terrain, as a pixel of a picture sees them. Records of drives by
// pictures depend on its draws: for each rock its albedo, then u and v of its piece.
#pragma once

#include <vector>

#include "core/random.h"
#include "rendering/image_scene.h"
#include "rendering/picture/picture_params.h"
#include "rendering/picture/texture_field.h"
#include "rendering/sun_params.h"
#include "terrain/terrain.h"

namespace rockyard::rendering {

// What a pixel sees of a surface: the mean of its albedo, and the normal of its mean slope.
struct SurfaceLook {
  double albedo = 0.0;
  math::Vector3 normal_W = math::Vector3::UnitZ();
};

// The textures of soil and rocks, fixed to the ground and to each rock:
//   albedo = mean (1 + contrast v),   normal ~ n - relief grad v,
// where v is a TextureField. The texture of soil is taken at (x, y) of W. The texture of rocks is
// taken in the rock's own axes, seen along the axis nearest to the normal. Where the normal has two
// or three components above 1/2, the textures seen along their axes are blended with the weights
// w_i = |n_i| - 1/2 over sqrt(sum w^2), which keep the variance. Each rock has a piece of the
// texture and a mean albedo of its own, drawn from (key, kRockLook, rock). Walls and the rover are
// plain. Soil draws from (key, kSoilTexture), rocks from (key, kRockTexture).
//
// An object serves one thread at a time, as it remembers what it has worked out of the textures.
// Objects of the same key give the same bits.
class TerrainLook {
 public:
  TerrainLook(const terrain::Terrain& terrain, const SunParams& sun, const LookParams& look,
              core::TrialKey key);

  // Returns the look of a point of a surface of which a pixel sees the parallelogram by_column_W,
  // by_row_W (m, in the tangent plane).
  SurfaceLook At(const SurfacePoint& point, const math::Vector3& by_column_W,
                 const math::Vector3& by_row_W);

  // Forgets textures where they take too much memory. Results stay the same.
  void Trim() {
    soil_.field.Trim();
    rock_.field.Trim();
  }

 private:
  struct Rock {
    double albedo;
    double cosine, sine;  // of its yaw
    math::Vector3 center_W;
    Eigen::Vector2d piece_m;  // where in the texture
  };
  struct Skin {
    TextureField field;
    double contrast;
    double relief_m;
  };

  static Skin MakeSkin(const TextureParams& texture, core::TrialKey key, core::Purpose purpose,
                       std::int64_t most_taps);
  SurfaceLook OfSoil(const SurfacePoint& point, const math::Vector3& by_column_W,
                     const math::Vector3& by_row_W);
  SurfaceLook OfRock(const Rock& rock, const SurfacePoint& point, const math::Vector3& by_column_W,
                     const math::Vector3& by_row_W);

  SunParams sun_;
  Skin soil_;
  Skin rock_;
  std::vector<Rock> rocks_;
};

}  // namespace rockyard::rendering
