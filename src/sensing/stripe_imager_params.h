// Parameters of the images of the light stripe sensor: light emitters and imager.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "rendering/imager_params.h"

namespace rockyard::sensing {

// How the light of one emitter is spread within its plane.
enum class BeamFan {
  kFull,            // evenly over fan_rad: about 300 scanlines, of which 4 are measured
  kThreeScanlines,  // over three scanlines around each measured point, an emitter for each point
};

// Cross section of the beam, square to the light plane.
enum class BeamProfile { kGaussian, kTopHat };

struct LaserParams {
  double input_power_w = 0.66;
  double optical_efficiency = 0.10;
  double wavelength_m = 850e-9;
  double beam_width_rad = 0.003;
  BeamProfile profile = BeamProfile::kGaussian;
  BeamFan fan = BeamFan::kFull;
  double speckle_contrast = 0.1;

  void Visit(core::FieldVisitor& v);
};

struct StripeImagerParams : rendering::ImagerParams {
  std::int64_t averaging_rows = 5;
  std::int64_t margin_rows = 0;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::sensing

template <>
struct rockyard::core::EnumNames<rockyard::sensing::BeamFan> {
  static constexpr std::array<std::string_view, 2> kNames{"full", "three_scanlines"};
};

template <>
struct rockyard::core::EnumNames<rockyard::sensing::BeamProfile> {
  static constexpr std::array<std::string_view, 2> kNames{"gaussian", "top_hat"};
};
