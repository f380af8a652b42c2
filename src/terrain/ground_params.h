// Parameters of the ground.
#pragma once

#include "core/fields.h"
#include "terrain/depression_params.h"
#include "terrain/soil_params.h"

namespace rockyard::terrain {

// The plane, its roughness, ditches and pits, and its soil.
struct GroundParams {
  double slope_rad = 0.0;
  double slope_direction_rad = 0.0;
  double roughness_rms_m = 0.0;
  double hurst_exponent = 0.8;
  double roughness_wavelength_m = 2.0;
  DitchesParams ditches;
  PitsParams pits;
  SoilParams soil;

  bool HasDepressions() const { return !ditches.x_m.empty() || !pits.x_m.empty(); }
  // Returns whether the ground is level everywhere.
  bool IsLevel() const { return slope_rad == 0.0 && roughness_rms_m == 0.0 && !HasDepressions(); }

  void Visit(core::FieldVisitor& v) {
    v.Angle("slope_deg", slope_rad,
            {.doc = "inclination of the ground plane",
             .min = 0.0,
             .max = 45.0,
             .origin = core::Origin::kSetting});
    v.Angle("slope_direction_deg", slope_direction_rad,
            {.doc = "uphill direction, from +x towards +y",
             .min = -360.0,
             .max = 360.0,
             .origin = core::Origin::kSetting});
    v.Real("roughness_rms_m", roughness_rms_m,
           {.doc = "root mean square height of the fractal roughness; 0 leaves a plane",
            .min = 0.0,
            .max = 0.5,
            .origin = core::Origin::kSetting});
    v.Real("hurst_exponent", hurst_exponent,
           {.doc = "Hurst exponent of the roughness",
            .min = 0.05,
            .max = 1.0,
            .origin = core::Origin::kAssumed,
            .source = "no effect at the default RMS of 0",
            .study_low = 0.5,
            .study_high = 1.0});
    v.Real("roughness_wavelength_m", roughness_wavelength_m,
           {.doc = "longest wavelength of the roughness",
            .min = 0.2,
            .max = 100.0,
            .origin = core::Origin::kAssumed,
            .source = "no effect at the default RMS of 0",
            .study_low = 1.0,
            .study_high = 8.0});
    v.Group("ditches", ditches, "straight trenches with round ends, one by one");
    v.Group("pits", pits, "round holes, one by one");
    v.Group("soil", soil, "what the ground does to wheels");
  }
};

}  // namespace rockyard::terrain
