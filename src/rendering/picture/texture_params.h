// How mottled a surface is, and at which scales.
#pragma once

#include <string_view>

#include "core/fields.h"

namespace rockyard::rendering {

// A texture is a sum of octaves, wavelengths falling by two from the longest to the finest, with
// variances in proportion to wavelength^(exponent - 2): the power spectrum over the plane then
// falls as f^-exponent (texture_field.h).
struct TextureParams {
  double contrast = 0.1;           // standard deviation of the albedo over its mean
  double spectral_exponent = 2.6;  // 2: each octave varies as much as the others
  double longest_wavelength_m = 1.0;
  double finest_wavelength_m = 0.003;
  double relief_slope = 0.15;  // standard deviation of the slope, along either axis

  bool operator==(const TextureParams&) const = default;
  void Visit(core::FieldVisitor& v);

 protected:
  // The same, where contrast and exponent were fitted to what `calibrated_to` says.
  void VisitAs(core::FieldVisitor& v, std::string_view calibrated_to);
};

// Loose stones of some millimetres to centimetres: contrast and exponent come from a real image.
struct GravelParams : TextureParams {
  void Visit(core::FieldVisitor& v);
};

// The ends of the family of soils, of which the first is dust that the wind has smoothed; and
// rocks.
TextureParams DriftTexture();
GravelParams GravelTexture();
TextureParams RockTexture();

// The texture at the given share of the way from `smooth` (0) to `rough` (1): wavelengths along
// their logarithms, the other values along a line.
TextureParams Between(const TextureParams& smooth, const TextureParams& rough, double share);

}  // namespace rockyard::rendering
