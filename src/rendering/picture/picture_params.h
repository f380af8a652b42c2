// Parameters of images of the terrain: what it looks like, and what the camera makes of it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"
#include "rendering/imager_params.h"
#include "rendering/picture/texture_params.h"

namespace rockyard::rendering {

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

  // An imager of the class of the engineering cameras of the Mars Exploration Rovers.
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
