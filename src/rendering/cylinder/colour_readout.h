// Images of the coloured cylinder in three channels: the light of sun, sky and ground on a surface,
// and the counts of a colour camera of one chip. The renderer of the cylinder lights its bodies by
// it; the study of cylinder finders reads the images out. No drive depends on its bits, only the
// records of that study.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "core/random.h"
#include "math/pose.h"
#include "rendering/cylinder/cylinder_params.h"
#include "vision/image.h"

namespace rockyard::rendering {

// Red, green, blue: reflectances, irradiances or radiances, all in proportion to light (no gamma).
using Colour = Eigen::Array3d;

inline Colour ToColour(const ColourValues& values) { return {values[0], values[1], values[2]}; }

using ColourPlane = vision::Image<float>;

// The three channels of an image. Values are radiances times pi (the irradiance of a white surface
// that looks the same), or counts.
using ColourPlanes = std::array<ColourPlane, 3>;

inline ColourPlanes MakePlanes(int columns, int rows) {
  const ColourPlane plane(columns, rows, 0.0F);
  return {plane, plane, plane};
}

inline void SetPixel(ColourPlanes& planes, int column, int row, const Colour& colour) {
  for (std::size_t i = 0; i < planes.size(); ++i) {
    planes[i].At(column, row) = static_cast<float>(colour[static_cast<Eigen::Index>(i)]);
  }
}

inline Colour PixelOf(const ColourPlanes& planes, int column, int row) {
  return {planes[0].At(column, row), planes[1].At(column, row), planes[2].At(column, row)};
}

// The light of sun, sky and ground. Directions are in L (cylinder_scene.h): x along the cameras'
// line of sight, y left, z up.
class ColourLight {
 public:
  // Strengths of sun and sky come from radiometry.h (Beer and Lambert), as shares of what a surface
  // that faces the sun gets outside of the atmosphere.
  ColourLight(const CylinderLightParams& light, const Colour& ground);

  // Returns the irradiance of a surface with that unit normal, with nothing before its sky:
  //   sun max(0, n.s) + sky (1 + n_z)/2 + ground (1 - n_z)/2
  // where the level ground sends back its reflectance times what falls on it. No surface shades
  // another.
  Colour On(const math::Vector3& normal_L) const;

  const math::Vector3& toward_sun_L() const { return toward_sun_L_; }
  // Returns the radiance of the sky times pi, in the units of On.
  const Colour& sky() const { return sky_; }

 private:
  math::Vector3 toward_sun_L_;
  Colour sun_;
  Colour sky_;
  Colour ground_;
};

// From light to counts. The steps are these; the first three are linear in light:
//   1. each channel takes the share `crosstalk` of its light from its neighbours in the spectrum,
//      c = (1 - k) R + k G for red, (1 - k) G + k (R + B)/2 for green, (1 - k) B + k G for blue;
//   2. gains: a level white card is grey with the sun at the elevation of the balance, and the
//      brightest channel of the level ground in the present light has exposure_level of the largest
//      count;
//   3. all channels are blurred by [a, 1 - 2a, a] along lines and columns, a = s^2/2; then the
//      differences of the channels from their brightness Y = 0.299 R + 0.587 G + 0.114 B are
//      blurred along the line by a Gaussian;
//   4. noise of each channel, with the deviation sqrt(read^2 + n N / W) at n of N counts, W the
//      full well;
//   5. counts: N (n / N)^gamma rounded and cut to 0 to N = 255.
class ColourReadout {
 public:
  ColourReadout(const ColourCameraParams& camera, const CylinderLightParams& light,
                const Colour& ground);

  // Returns counts before noise and gamma (steps 1 to 3): they may be above 255.
  ColourPlanes Counts(const ColourPlanes& light) const;
  // Returns the image with noise and gamma (steps 4 and 5). Noise is drawn from (key,
  // kCylinderNoise, 3 image + channel) by pixel.
  vision::ColourImage Read(const ColourPlanes& counts, core::TrialKey key,
                           std::uint32_t image) const;

  // Returns the response to even light, in counts.
  Colour CountsOf(const Colour& light) const { return gains_ * Mixed(light); }

 private:
  Colour Mixed(const Colour& light) const;
  void BlurColours(ColourPlanes& planes) const;

  ColourCameraParams camera_;
  Colour gains_;
};

}  // namespace rockyard::rendering
