// Parameters of images of the terrain: what the terrain looks like (scenario group sensors.look),
// and what the camera makes of it (sensors.stereo.images.camera). Only rendered images depend on
// them, the light stripe's not. Error models that were fitted to such images stand for these values
// until they are fitted anew.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"
#include "rendering/imager_params.h"

namespace rockyard::rendering {

// How mottled a surface is, and at which scales. A texture is a sum of octaves. Their wavelengths
// halve from the longest to the finest, their variances are in proportion to wavelength^(exponent -
// 2): the power spectrum over the plane then falls as f^-exponent (texture_field.h).
struct TextureParams {
  double contrast = 0.1;           // standard deviation of the albedo over its mean
  double spectral_exponent = 2.6;  // 2: each octave varies as much as the others
  double longest_wavelength_m = 1.0;
  double finest_wavelength_m = 0.003;
  double relief_slope = 0.15;  // standard deviation of the slope, along either axis

  bool operator==(const TextureParams&) const = default;
  void Visit(core::FieldVisitor& v);

 protected:
  // Visits the fields. Where `calibrated_to` is not empty, it is told as what contrast and exponent
  // were fitted to.
  void VisitAs(core::FieldVisitor& v, std::string_view calibrated_to);
};

// Loose stones of some millimetres to centimetres: contrast and exponent come from a real image.
struct GravelParams : TextureParams {
  void Visit(core::FieldVisitor& v);
};

// Return the ends of the family of soils, where drift is dust that the wind has smoothed, and the
// texture of rocks.
TextureParams DriftTexture();
GravelParams GravelTexture();
TextureParams RockTexture();

// Returns the texture at the given share of the way from `smooth` (0) to `rough` (1). Logarithms of
// wavelengths and the other values are interpolated linearly.
TextureParams Between(const TextureParams& smooth, const TextureParams& rough, double share);

// What soil and rocks look like, beside the albedos that come with the sun (sun_params.h).
struct LookParams {
  double soil_graininess = 0.5;  // share of the way from drift to gravel
  TextureParams drift = DriftTexture();
  GravelParams gravel = GravelTexture();
  TextureParams rock = RockTexture();
  double rock_albedo_spread = 0.15;
  double lommel_seeliger_share = 0.0;
  double sun_diameter_rad = math::DegToRad(0.35);
  std::int64_t edge_samples = 4;
  std::int64_t texture_taps = 8;

  TextureParams Soil() const { return Between(drift, gravel, soil_graininess); }
  void Visit(core::FieldVisitor& v);
};

// How the light falls off from the axis outwards.
enum class Vignetting {
  kNone,
  kNatural,     // solid angle and pupil: cos^4 for a pinhole
  kPolynomial,  // 1 + c2 x^2 + c4 x^4, x the angle from the axis over that of the image's corner
};

// Whether the camera divides by its flat field before it delivers an image.
enum class FlatField { kRaw, kCorrected };

struct PictureCameraParams {
  ImagerParams imager = EngineeringImager();
  double pixel_pitch_m = 12e-6;
  double wavelength_m = 700e-9;
  double blur_px = 0.5;
  Vignetting vignetting = Vignetting::kNatural;
  double vignetting_c2 = -0.2;
  double vignetting_c4 = 0.0;
  FlatField flat_field = FlatField::kCorrected;
  double stuck_share = 1e-5;

  // Returns an imager of the class of the engineering cameras of the Mars Exploration Rovers.
  static ImagerParams EngineeringImager();

  double PixelArea() const { return pixel_pitch_m * pixel_pitch_m; }
  void Visit(core::FieldVisitor& v);
};

struct PictureParams {
  LookParams look;
  PictureCameraParams camera;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::rendering

template <>
struct rockyard::core::EnumNames<rockyard::rendering::Vignetting> {
  static constexpr std::array<std::string_view, 3> kNames{"none", "natural", "polynomial"};
};

template <>
struct rockyard::core::EnumNames<rockyard::rendering::FlatField> {
  static constexpr std::array<std::string_view, 2> kNames{"raw", "corrected"};
};
