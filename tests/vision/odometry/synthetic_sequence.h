// Images of a textured plane by a pair of cameras at any pose: a world whose motions are known.
#pragma once

#include <cstdint>

#include "vision/cameras/rectification.h"
#include "vision/odometry/odometer.h"

namespace rockyard::vision {

// A plane z = 0 of the outer frame W, seen from above by a pair that looks ahead and down.
struct PlaneWorld {
  double contrast = 25.0;  // standard deviation of grey levels; 0: nothing to see
  double noise = 1.0;      // of each pixel, grey levels
  int waves = 24;          // of the texture, of 2.5 to 60 cm
  std::uint32_t number = 0;
  // Boards, 30 cm wide and 20 cm high, stand across the view at the nodes of a grid of this width,
  // every other one; 0: none. What lies behind them moves otherwise.
  double boards_m = 0.0;
};

// Cameras of `size` over 45 deg, 20 cm apart, 1.2 m above R's origin and 35 deg down. The outer
// frame R: x ahead, y to the left, z up.
RectifiedPair PlanePair(const ImageSize& size);

// What the pair sees at X_WR. `moment` numbers the noise. Waves that a pixel's footprint does not
// resolve are left out.
AlignedImages SeePlane(const RectifiedPair& pair, const math::Transform& X_WR,
                       const PlaneWorld& world, std::uint32_t moment);

// The disparity, px, of the plane at a pixel of the left image of a pair that stands at the
// identity.
double PlaneDisparity_px(const RectifiedPair& pair, const Pixel& left_pixel);

}  // namespace rockyard::vision
