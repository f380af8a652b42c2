#include "sensing/stereo_depth.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;

// A surface this close to a point does not hide it.
constexpr double kOcclusionMargin_m = 0.0005;

}  // namespace

std::vector<double> InverseDepths(const terrain::Terrain& terrain, const StereoView& view_W,
                                  double max_range_m) {
  std::vector<double> depths;
  depths.reserve(static_cast<std::size_t>(view_W.rows) * static_cast<std::size_t>(view_W.columns));
  for (int row = 0; row < view_W.rows; ++row) {
    for (int column = 0; column < view_W.columns; ++column) {
      const Vector3 ray_W = view_W.Ray(column, row);
      const double length = ray_W.norm();
      const auto hit = terrain.CastRay(view_W.eye, ray_W / length, max_range_m);
      depths.push_back(hit && hit->distance_m > 0.0 ? length / hit->distance_m : 0.0);
    }
  }
  return depths;
}

void HideFromRightEye(const terrain::Terrain& terrain, const StereoView& view_W,
                      std::vector<double>& inverse_depths) {
  std::size_t pixel = 0;
  for (int row = 0; row < view_W.rows; ++row) {
    for (int column = 0; column < view_W.columns; ++column, ++pixel) {
      const double w = inverse_depths[pixel];
      if (w <= 0.0) continue;
      const Vector3 p_W = view_W.eye + view_W.Ray(column, row) / w;
      const bool outside = column + 0.5 < view_W.focal_px * view_W.baseline_m * w;
      if (outside || terrain.Occluded(view_W.right_eye, p_W, kOcclusionMargin_m)) {
        inverse_depths[pixel] = 0.0;
      }
    }
  }
}

}  // namespace rockyard::sensing
