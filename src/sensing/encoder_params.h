// Parameters of the wheel encoders.
#pragma once

#include "core/fields.h"

namespace rockyard::sensing {

// The distance error of the encoders (Matthies 1995, section 5).
struct EncoderParams {
  double distance_variance_m2_per_m = 0.0039;
  double physics_variance_m2_per_m = 0.0;
  double level_sand_gain = 1.0;
  double noise_stretch_m = 0.067;

  // Returns what the encoders add to the distance error that wheel slip already causes, m2 a metre
  // that the wheels roll.
  double noise_variance_m2_per_m() const {
    return (distance_variance_m2_per_m - physics_variance_m2_per_m) / level_sand_gain;
  }

  void Visit(core::FieldVisitor& v) {
    using core::Origin;
    v.Real("distance_variance_m2_per_m", distance_variance_m2_per_m,
           {.doc = "growth of the dead-reckoned distance's variance on level, rock-free sand",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kPublished,
            .source = "Matthies 1995 sec. 5"});
    v.Real("physics_variance_m2_per_m", physics_variance_m2_per_m,
           {.doc = "share of it that the simulated wheels already yield on level sand",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kCalibrated,
            .source = "straight 7 m runs of the simulated rover on level sand"});
    v.Require("physics_variance_m2_per_m", physics_variance_m2_per_m <= distance_variance_m2_per_m,
              "is larger than distance_variance_m2_per_m, so that no encoder noise could bring the "
              "sum to the published value",
              "use a value up to distance_variance_m2_per_m");
    v.Real("level_sand_gain", level_sand_gain,
           {.doc = "growth of the dead-reckoned distance's variance on level sand over that of the "
                   "noise per metre rolled: an odometer of scale s takes s^2 of the variance, over "
                   "1 / s as many metres, so that it is s",
            .min = 0.1,
            .max = 10.0,
            .origin = Origin::kCalibrated,
            .source = "closed form: perception.dead_reckoning.distance_scale; 1: what wheels roll "
                      "is taken for distance"});
    v.Real("noise_stretch_m", noise_stretch_m,
           {.doc = "travel over which the distance error keeps its rate",
            .min = 0.001,
            .max = 100.0,
            .origin = Origin::kPublished,
            .source = "Matthies 1995 sec. 5: steps of 6.7 cm"});
  }
};

}  // namespace rockyard::sensing
