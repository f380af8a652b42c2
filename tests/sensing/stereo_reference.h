// The same image as StereoScene, pixel by pixel through the terrain's own ray casting.
#pragma once

#include "sensing/stereo_depth.h"

namespace rockyard::sensing {

inline DepthImage ReferenceInverseDepths(const terrain::Terrain& terrain, const StereoView& view_W,
                                         double max_range_m) {
  DepthImage image = DepthImage::Zero(view_W.rows, view_W.columns);
  for (int row = 0; row < view_W.rows; ++row) {
    for (int column = 0; column < view_W.columns; ++column) {
      const math::Vector3 ray_W = view_W.Ray(column, row);
      const auto hit = terrain.CastRay(view_W.eye, ray_W.normalized(), max_range_m);
      if (hit && hit->distance_m > 0.0) image(row, column) = ray_W.norm() / hit->distance_m;
    }
  }
  return image;
}

inline void ReferenceHideFromRightEye(const terrain::Terrain& terrain, const StereoView& view_W,
                                      DepthImage& image) {
  constexpr double kMargin_m = 0.0005;
  for (int row = 0; row < view_W.rows; ++row) {
    for (int column = 0; column < view_W.columns; ++column) {
      double& pixel = image(row, column);
      if (pixel <= 0.0) continue;
      const math::Vector3 p_W = view_W.eye + view_W.Ray(column, row) / pixel;
      // The image begins half a pixel left of the middle of its first column.
      const bool outside = view_W.focal_px * view_W.baseline_m * pixel > column + 0.5;
      if (outside || terrain.Occluded(view_W.right_eye, p_W, kMargin_m)) pixel = 0.0;
    }
  }
}

}  // namespace rockyard::sensing
