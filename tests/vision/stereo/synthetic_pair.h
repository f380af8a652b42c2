// Pairs of images with exact truth: a texture of limited bandwidth on surfaces of known disparity.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "vision/image.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// What is seen. Lengths are pixels of the left image, grey levels are those of 8 bits.
struct Scene {
  int width = 256;
  int height = 240;
  // Disparity at a place of the left image; at a step, the larger one hides the smaller.
  std::function<double(double x_px, double y_px)> disparity = [](double, double) { return 10.0; };
  // Row of the left image that a place of the right image shows: other than y, the pair is not
  // rectified, and what is hidden is told of the rectified one.
  std::function<double(double x_px, double y_px)> left_row = [](double, double y) { return y; };
  double mean = 110.0;
  double contrast = 25.0;         // standard deviation of the texture
  double shortest_wave_px = 2.5;  // of the texture; Nyquist's is 2
  double longest_wave_px = 24.0;
  double noise = 1.5;  // standard deviation, independent in each pixel of both images
  double right_gain = 1.0;
  double right_offset = 0.0;
  std::uint32_t number = 0;  // of the texture and the noise
};

struct SyntheticPair {
  GrayImage left;
  GrayImage right;
  Image<double> truth;         // disparity of each left pixel
  Image<std::uint8_t> hidden;  // 1 where the right eye does not see what the left one sees
};

// The texture is a sum of waves of random direction, phase and length, known at every place, so
// that neither image is a resampling of the other. It is fixed to the surface: the left image shows
// it as it is, the right one, at (x - d, y), what the left one shows at (x, y), and in other rows
// than y where left_row says so.
SyntheticPair MakePair(const Scene& scene);

// Disparities of ground that rises from one to three quarters of a range down an image of this
// size, with a step.
std::function<double(double, double)> SteppedGround(int width, int height, double range_px);

// The defaults over these disparities.
inline StereoPipelineParams Range(int min_disparity, int disparities) {
  return {.correlator = {.min_disparity_px = min_disparity, .disparities = disparities}};
}

std::string HashOf(const DisparityImage& image);

}  // namespace rockyard::vision
