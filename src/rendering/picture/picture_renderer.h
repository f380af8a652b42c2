// Images of the terrain through any camera: the stereo cameras' images are rendered here. Records
// of drives by these images depend on all bits of the radiance; tiles and blocks only sift rocks.
#pragma once

#include <vector>

#include "math/pose.h"
#include "rendering/picture/picture.h"
#include "rendering/picture/picture_scene.h"
#include "rendering/picture/pixel_rays.h"
#include "rendering/picture/terrain_look.h"

namespace rockyard::rendering {

// Renders a scene through one camera. A pixel takes the light of the ray through its middle, with
// textures filtered to what the pixel covers of the surface. Where one of its four neighbours shows
// another surface, the same surface behind an edge, or another sunlight, the pixel is split into
// edge_samples^2 rays, unless the rays in its corners show what its middle does. The parts of a
// pixel take the texture as the whole pixel sees it, once for each surface.
//
// Deviations: nothing reflects twice, and nothing smaller than a pixel is seen between the middles
// of pixels; relief of the texture does not move a silhouette.
class PictureRenderer {
 public:
  // X_WA is the pose of the camera's outer frame. Scene and rays must outlive this.
  PictureRenderer(const PictureScene& scene, const LookParams& look, const PixelRays& rays,
                  const math::Transform& X_WA);

  // Renders the rows first .. last - 1 into a picture of the camera's size. The bits of a row must
  // not depend on which other rows are rendered with it, nor on what `look` has worked out before:
  // bands of rows may be given to threads, each with a TerrainLook of its own.
  void RenderRows(int first, int last, TerrainLook& look, Picture& picture) const;

 private:
  struct Pixel {
    Met met;
    bool sees = false;
  };
  // One of the rays of a pixel that is split.
  struct Part {
    math::Vector3 ray_W;
    Pixel pixel;
  };
  using Row = std::vector<Pixel>;
  struct Band;
  class PixelLooks;

  math::Vector3 OriginOf(const vision::Ray& ray) const { return X_WA_ * ray.origin; }
  math::Vector3 DirectionOf(const vision::Ray& ray) const { return X_WA_.linear() * ray.direction; }
  SurfaceLook LookAt(const SurfacePoint& point, const math::Vector3& ray_W, double range_m,
                     int column, int row, TerrainLook& look) const;
  RayCone InWorld(RayCone cone) const {
    cone.axis = X_WA_.linear() * cone.axis;
    return cone;
  }
  void FindInBlocks(int block_row, Band& band) const;
  const std::vector<int>& Candidates(int column, int row, Band& band) const;
  const std::vector<int>& InPixel(int column, int row, Band& band) const;
  const Row& MeetRow(int row, Band& band) const;
  bool IsEdge(const Pixel& a, const Pixel& b) const;
  bool HasEdge(int column, int row, Band& band) const;
  double WholePixel(int column, int row, const Met& met, TerrainLook& look) const;
  double SplitPixel(int column, int row, Band& band, TerrainLook& look) const;

  const PictureScene& scene_;
  const PixelRays& rays_;
  math::Transform X_WA_;
  int edge_samples_;
};

}  // namespace rockyard::rendering
