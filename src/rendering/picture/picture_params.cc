#include "rendering/picture/picture_params.h"

#include "math/functions.h"

namespace rockyard::rendering {
namespace {

using core::Assumed;
using core::Published;
using core::Setting;

double Mix(double a, double b, double share) { return a + share * (b - a); }

// a (b/a)^share.
double MixLog(double a, double b, double share) { return a * math::Pow(b / a, share); }

}  // namespace

TextureParams DriftTexture() { return {0.05, 3.6, 1.0, 0.003, 0.04}; }
GravelParams GravelTexture() { return {{0.21, 2.1, 0.5, 0.003, 0.25}}; }
TextureParams RockTexture() { return {0.14, 2.4, 0.3, 0.003, 0.20}; }

TextureParams Between(const TextureParams& smooth, const TextureParams& rough, double share) {
  return {Mix(smooth.contrast, rough.contrast, share),
          Mix(smooth.spectral_exponent, rough.spectral_exponent, share),
          MixLog(smooth.longest_wavelength_m, rough.longest_wavelength_m, share),
          MixLog(smooth.finest_wavelength_m, rough.finest_wavelength_m, share),
          Mix(smooth.relief_slope, rough.relief_slope, share)};
}

void TextureParams::Visit(core::FieldVisitor& v) { VisitAs(v, ""); }

void GravelParams::Visit(core::FieldVisitor& v) {
  VisitAs(
      v,
      "contrast and spectrum of three parts of a Navcam image of stony ground, sun at 8 degrees "
      "(Curiosity, sol 3423, NRB_701383954RAS_F0933408NCAM00200M1; texture.py)");
}

void TextureParams::VisitAs(core::FieldVisitor& v, std::string_view calibrated_to) {
  const auto fitted = [&](std::string_view name, double& value, core::FieldInfo info) {
    if (!calibrated_to.empty()) {
      info.origin = core::Origin::kCalibrated;
      info.source = calibrated_to;
    }
    v.Real(name, value, info);
  };
  fitted("contrast", contrast,
         Assumed("standard deviation of the albedo over its mean, at the finest scale",
                 "Mars from the ground: some percent where dust lies, more among stones",
                 {0.0, 0.5}, {0.0, 0.25}));
  fitted("spectral_exponent", spectral_exponent,
         Assumed("the power spectrum of the albedo over the plane falls as frequency to minus this",
                 "natural images have about 2 (Field 1987)", {0.0, 6.0}, {1.5, 4.0}));
  v.Real("longest_wavelength_m", longest_wavelength_m,
         Assumed("of the octaves of albedo and relief", "larger patches do not help stereo",
                 {0.01, 10.0}, {0.1, 3.0}));
  v.Real("finest_wavelength_m", finest_wavelength_m,
         Assumed("of the octaves of albedo and relief",
                 "below what the pixels of rover cameras see of the ground", {0.001, 1.0},
                 {0.002, 0.1}));
  v.Require("finest_wavelength_m", finest_wavelength_m <= longest_wavelength_m,
            "is above longest_wavelength_m", "use a value of longest_wavelength_m or less");
  v.Real("relief_slope", relief_slope,
         Assumed("standard deviation of the slope along an axis of the relief that goes with the "
                 "albedo, bright where high; it shades, but hides and moves nothing",
                 "grains and clods that the terrain does not hold", {0.0, 1.0}, {0.0, 0.5}));
}

// Sources give 600 to 800 nm and a signal to noise above 200 (Lakdawalla 2018, table 7.1;
// Schwochert and Maki 2005); all else is what such a camera may have.
ImagerParams PictureCameraParams::EngineeringImager() {
  ImagerParams imager;
  imager.f_number = 12.0;
  imager.filter_width_m = 200e-9;
  imager.blur_px = 0.0;
  imager.black_level = 0.02;
  imager.ccd.quantum_efficiency = 0.4;
  imager.ccd.fill_factor = 1.0;
  imager.ccd.full_well_e = 170000.0;
  imager.ccd.read_noise_e = 25.0;
  imager.ccd.dark_current_e_s = 20.0;
  imager.ccd.adc_bits = 8;
  imager.ccd.response_nonuniformity = 0.01;
  imager.ccd.offset_nonuniformity_e = 25.0;
  imager.exposure.shortest_s = 0.005;
  imager.exposure.longest_s = 10.0;
  imager.exposure.target_fill = 0.8;
  imager.exposure.brightest_share = 0.01;
  return imager;
}

void LookParams::Visit(core::FieldVisitor& v) {
  v.Real("soil_graininess", soil_graininess,
         Setting("texture of the soil: 0 is drift, 1 is gravel, between them each value is mixed",
                 {0.0, 1.0}));
  v.Group("drift", drift, "the smooth end of the family of soils");
  v.Group("gravel", gravel, "the rough end of the family of soils");
  v.Group("rock", rock, "surface of rocks");
  v.Real("rock_albedo_spread", rock_albedo_spread,
         Assumed("standard deviation of the albedos of rocks over their mean",
                 "dusty and bare rocks side by side", {0.0, 0.3}, {0.0, 0.3}));
  v.Real("lommel_seeliger_share", lommel_seeliger_share,
         Assumed("share of the law of Lommel and Seeliger in the light that surfaces send back; "
                 "the rest is Lambert's: the lunar-Lambert law",
                 "McEwen 1991 (Icarus 92, 298) has the law; 0: as in the light stripe images",
                 {0.0, 1.0}, {0.0, 0.8}));
  v.Angle("sun_diameter_deg", sun_diameter_rad,
          Published("of the sun's disc, which makes the edges of shadows soft; 0 for a point",
                    "0.533 deg at 1 AU, seen from 1.52 AU", {0.0, 5.0}));
  v.Integer("edge_samples", edge_samples,
            Setting("pixels in which a surface or the sunlight ends are split in this many parts "
                    "each way; 1 leaves edges jagged",
                    {1, 16}));
  v.Integer("texture_taps", texture_taps,
            Setting("most places along what a pixel covers of a surface at which its texture is "
                    "looked up; longer footprints are blurred across",
                    {1, 16}));
}

void PictureCameraParams::Visit(core::FieldVisitor& v) {
  imager.VisitOptics(v);
  v.Real("pixel_pitch_m", pixel_pitch_m,
         Assumed("side of a pixel",
                 "1024 x 1024 pixels of 0.82 mrad (Maki et al. 2003, abstract) through a lens of "
                 "14.6 mm, which is not at hand",
                 {1e-6, 1e-4}, {7e-6, 15e-6}));
  v.Real("wavelength_m", wavelength_m,
         Assumed("in the middle of the passband",
                 "Navcams see 600 to 800 nm (Lakdawalla 2018, table 7.1), or are centred at 650 nm "
                 "(Maki et al. 2012, abstract)",
                 {3e-7, 1.1e-6}, {650e-9, 700e-9}));
  v.Real("spread_px", blur_px,
         Assumed("standard deviation of the image of a point, in pixels both ways: lens, and "
                 "charge that strays; pixels integrate over their area besides",
                 "a sharp lens, matched to its pixels", {0.0, 10.0}, {0.0, 1.5}));
  v.Choice("vignetting", vignetting, Setting("how light falls off from the axis outwards"));
  v.Real("vignetting_c2", vignetting_c2,
         Assumed("of polynomial vignetting, 1 + c2 x^2 + c4 x^4 with x = 1 in the corners",
                 "small lenses that are stopped down", {-1.0, 1.0}, {-0.5, 0.0}));
  v.Real(
      "vignetting_c4", vignetting_c4,
      Assumed("see vignetting_c2", "small lenses that are stopped down", {-1.0, 1.0}, {-0.3, 0.0}));
  v.Require("vignetting_c2", 1.0 + vignetting_c2 + vignetting_c4 > 0.0,
            "leaves the corners of the image without light", "use c2 + c4 above -1");
  v.Choice("flat_field", flat_field,
           Setting("whether vignetting and the pixels' responses are divided out on board"));
  v.Real("stuck_share", stuck_share,
         Assumed("share of pixels that always show the least or the largest count",
                 "some pixels of a megapixel after years of radiation", {0.0, 0.1}, {0.0, 1e-3}));
  imager.VisitDetectors(v);
}

void PictureParams::Visit(core::FieldVisitor& v) {
  v.Group("look", look, "textures, reflection, sun's disc");
  v.Group("camera", camera, "lens, filter, imager, exposure, faults");
}

}  // namespace rockyard::rendering
