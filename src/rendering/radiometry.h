// From light to electrons: the sun in the passband, the camera equation, and the exposure time.
// Stripe images and pictures of the terrain share all of them, colour images of the cylinder the
// sun. Records of drives by images depend on the bits of all; of error models only the shade of
// stereo does, on toward_sun_W (sensing/sun_shade.h).
#pragma once

#include <vector>

#include "math/pose.h"
#include "messages/camera.h"
#include "rendering/imager_params.h"
#include "rendering/sun_params.h"

namespace rockyard::rendering {

// Sunlight within the passband of the filter, before the filter's transmission.
struct SunLight {
  math::Vector3 toward_sun_W = math::Vector3::UnitZ();
  double direct_w_m2 = 0.0;  // on a surface that faces the sun
  double sky_w_m2 = 0.0;     // from the whole sky on a horizontal surface
};

// Returns the light of sun and sky. The direct part follows Beer and Lambert's law; the sky has a
// share of what the direct part lost:
//   E_direct = E0 / d^2 exp(-tau / sin h) w,
//   E_sky    = k (E0 / d^2 w - E_direct) sin h
// with elevation h, equivalent width w of the filter, diffuse share k. The sky is equally bright
// everywhere, though dust makes it brightest around the sun.
SunLight MakeSunLight(const SunParams& sun, double filter_width_m);

// Returns the radiance of a Lambert surface in the light `sun`, W/m2/sr:
//   L = albedo / pi (E_direct max(0, n.s) [sunlit] + E_sky (1 + n_z) / 2).
double SunRadiance(const SunLight& sun, double albedo, const math::Vector3& normal_W, bool sunlit);

// Returns the electrons per second on a pixel of the optical axis for one W/m2/sr of light of the
// wavelength wavelength_m:
//   pi A T eta lambda / (4 N^2 h c)
// (camera equation E = pi L T / (4 N^2), e.g. Holst and Lomheim 2011; eta: quantum efficiency times
// fill factor; T: lens times filter; A: area of a pixel).
double ElectronsPerRadiance(const ImagerParams& imager, double pixel_m2, double wavelength_m);

// Returns the electrons per second on a pixel off the axis over those on the axis: the solid angle
// of the pixel over that of the central one, times the cosine by which the entrance pupil shrinks.
// For a pinhole that is cos^4. Real wide-angle lenses tilt their pupil and lose less.
double RelativeIllumination(const messages::Camera& camera, double column_px, double row_px);

// Returns the time, s, at which the loop of exposure control settles:
//   t = target_fill * full_well / (rate + dark current),
// within the limits of the parameters, with the rate that brightest_share of the metered pixels
// exceed. `rates_e_s` are the photoelectrons per second of the metered pixels, by sunlight alone
// and in any order; where there are none, the time is the longest.
double ExposureTime(const ImagerParams& imager, std::vector<double> rates_e_s);

}  // namespace rockyard::rendering
