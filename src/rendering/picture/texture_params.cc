#include "rendering/picture/texture_params.h"

#include <cmath>

namespace rockyard::rendering {
namespace {

using core::Origin;

double Mix(double a, double b, double share) { return a + share * (b - a); }

// a (b/a)^share.
double MixLog(double a, double b, double share) { return a * std::pow(b / a, share); }

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
  const auto field = [&v](std::string_view name, double& value, core::FieldInfo info) {
    info.origin = Origin::kAssumed;
    v.Real(name, value, info);
  };
  const auto fitted = [&](std::string_view name, double& value, core::FieldInfo info) {
    if (calibrated_to.empty()) return field(name, value, info);
    info.origin = Origin::kCalibrated;
    info.source = calibrated_to;
    v.Real(name, value, info);
  };
  fitted("contrast", contrast,
         {.doc = "standard deviation of the albedo over its mean, at the finest scale",
          .min = 0.0,
          .max = 0.5,
          .source = "Mars from the ground: some percent where dust lies, more among stones",
          .study_low = 0.0,
          .study_high = 0.25});
  fitted("spectral_exponent", spectral_exponent,
         {.doc = "the power spectrum of the albedo over the plane falls as frequency to minus this",
          .min = 0.0,
          .max = 6.0,
          .source = "natural images have about 2 (Field 1987)",
          .study_low = 1.5,
          .study_high = 4.0});
  field("longest_wavelength_m", longest_wavelength_m,
        {.doc = "of the octaves of albedo and relief",
         .min = 0.01,
         .max = 10.0,
         .source = "larger patches do not help stereo",
         .study_low = 0.1,
         .study_high = 3.0});
  field("finest_wavelength_m", finest_wavelength_m,
        {.doc = "of the octaves of albedo and relief",
         .min = 0.001,
         .max = 1.0,
         .source = "below what the pixels of rover cameras see of the ground",
         .study_low = 0.002,
         .study_high = 0.1});
  v.Require("finest_wavelength_m", finest_wavelength_m <= longest_wavelength_m,
            "is above longest_wavelength_m", "use a value of longest_wavelength_m or less");
  field("relief_slope", relief_slope,
        {.doc = "standard deviation of the slope along an axis of the relief that goes with the "
                "albedo, bright where high; it shades, but hides and moves nothing",
         .min = 0.0,
         .max = 1.0,
         .source = "grains and clods that the terrain does not hold",
         .study_low = 0.0,
         .study_high = 0.5});
}

}  // namespace rockyard::rendering
