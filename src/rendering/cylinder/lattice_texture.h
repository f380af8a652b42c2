// Mottling along a line of pixels: value noise on lattices, filtered to the pixel's size.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"

namespace rockyard::rendering {

// A line of pixels on a plane with coordinates (u, v), m: u is constant, v = first_v + k step_v.
struct TextureLine {
  double u_m = 0.0;
  double first_v_m = 0.0;
  double step_v_m = 0.0;  // not 0
  double footprint_u_m = 0.0;
};

// Octave j lies on a lattice of spacing s_j = 4 mm 2^j and interpolates normal numbers of its nodes
// (PixelNoise by node, substream j) linearly along both axes. A line takes the octaves with
// spacings between 2 and 32 of its pixels' width |step_v|, the first and the last faded, and less
// of those that are finer than the footprint along u by the root of s / footprint_u, as the mean of
// independent cells is. Cost: 5 ns a pixel.
class LatticeTexture {
 public:
  explicit LatticeTexture(core::TrialKey key) : key_(key) {}

  // Adds `deviation` times noise of about unit variance to every value of the line.
  void AddTo(const TextureLine& line, double deviation, std::span<float> values);
  // The same with the one lattice of that spacing's number.
  void AddOctave(const TextureLine& line, int octave, double deviation, std::span<float> values);

  static double SpacingOf(int octave);

 private:
  core::TrialKey key_;
  std::vector<float> nodes_;
};

}  // namespace rockyard::rendering
