// Images of random textures that move, for tests and benchmarks of visual odometry.
#pragma once

#include <cstdint>
#include <vector>

#include "vision/image.h"

namespace rockyard::vision {

// A texture that is known at every place: a sum of waves of random direction, phase and length.
class WaveTexture {
 public:
  // Wave lengths are uniform in their logarithm, pixels.
  WaveTexture(std::uint32_t number, double shortest_px, double longest_px);

  // Mean 0, standard deviation 1.
  double At(double x, double y) const;

  // Grey levels of the pixels from (left, top) on, with normal noise of the standard deviation
  // `noise`, from a stream of its own number.
  GrayImage Render(int width, int height, double left, double top, double contrast, double noise,
                  std::uint32_t noise_number) const;

 private:
  struct Wave {
    double x, y, phase;
  };
  std::vector<Wave> waves_;
  std::uint32_t number_;
};

// Pixels of random grey levels from 0 to levels - 1.
GrayImage RandomImage(int width, int height, int levels, std::uint32_t number);

}  // namespace rockyard::vision
