// An image of the terrain before the camera's own faults, with the truth about every pixel.
#pragma once

#include <Eigen/Core>
#include <limits>

#include "rendering/surface_point.h"
#include "vision/image.h"

namespace rockyard::rendering {

// What lies behind the middle of each pixel, and the light from all of it.
struct Picture {
  // Beside the codes of SurfacePoint: the lens does not look anywhere.
  static constexpr int kBlind = -5;

  Picture() = default;
  Picture(int columns, int rows)
      : radiance_w_m2_sr(columns, rows),
        range_m(columns, rows, std::numeric_limits<double>::infinity()),
        normal_W(columns, rows, Eigen::Vector3f::Zero()),
        surface(columns, rows, kBlind),
        sunlit(columns, rows) {}

  int columns() const { return radiance_w_m2_sr.width(); }
  int rows() const { return radiance_w_m2_sr.height(); }

  // Mean over the pixel, within the passband.
  vision::Image<float> radiance_w_m2_sr;
  // From the ray's origin to the surface; infinite where there is none.
  vision::Image<double> range_m;
  vision::Image<Eigen::Vector3f> normal_W;  // of the terrain, without the texture's relief
  vision::Image<int> surface;               // a rock, a code of SurfacePoint, or kBlind
  vision::Image<float> sunlit;              // share of the sun that the surface sees
};

}  // namespace rockyard::rendering
