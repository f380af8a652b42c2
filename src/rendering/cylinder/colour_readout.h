// From light to the counts of a colour camera of one chip.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "rendering/cylinder/colour_light.h"
#include "rendering/cylinder/cylinder_params.h"
#include "vision/colour_image.h"

namespace rockyard::rendering {

// Steps, all but the last linear in light:
//   1. each channel takes the share `crosstalk` of its light from its neighbours in the spectrum,
//      c = (1 - k) R + k G for red, (1 - k) G + k (R + B)/2 for green, (1 - k) B + k G for blue;
//   2. gains: a level white card is grey with the sun at the elevation of the balance, and the
//      brightest channel of the level ground in the present light has exposure_level of the largest
//      count;
//   3. blur of all by [a, 1 - 2a, a] along lines and columns, a = s^2/2; then, along the line, of
//      what the channels differ from their brightness Y = 0.299 R + 0.587 G + 0.114 B by a
//      Gaussian;
//   4. noise of each channel: of deviation sqrt(read^2 + n N / W) at n of N counts, full well W;
//   5. counts: N (n / N)^gamma rounded and cut to 0 to N = 255.
class ColourReadout {
 public:
  ColourReadout(const ColourCameraParams& camera, const CylinderLightParams& light,
                const Colour& ground);

  // Counts of 8 bits before noise and gamma: may be above 255.
  ColourPlanes Counts(const ColourPlanes& light) const;
  // Noise is that of (key, kCylinderNoise, 3 image + channel) by pixel.
  vision::ColourImage Read(const ColourPlanes& counts, core::TrialKey key,
                           std::uint32_t image) const;

  // The response to even light, in counts.
  Colour CountsOf(const Colour& light) const { return gains_ * Mixed(light); }

 private:
  Colour Mixed(const Colour& light) const;
  void BlurColours(ColourPlanes& planes) const;

  ColourCameraParams camera_;
  Colour gains_;
};

}  // namespace rockyard::rendering
