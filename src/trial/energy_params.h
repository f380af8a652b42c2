// Electrical power by activity and the batteries.
#pragma once

#include "core/fields.h"

namespace rockyard::trial {

struct EnergyParams {
  double cpu_W = 3.77;
  double gyro_W = 0.80;
  double accelerometers_W = 0.82;
  double imaging_W = 0.75;
  double cmos_imaging_share = 0.1;
  double laser_supply_efficiency = 1.32 / 2.01;
  double stereo_imaging_W = 0.75;
  double computing_W = 0.0;
  double driving_W = 8.28;
  double steering_W = 6.70;
  double battery_wh = 50.0;

  void Visit(core::FieldVisitor& v) {
    using core::Origin;
    v.Real("cpu_W", cpu_W,
           {.doc = "computer and I/O",
            .min = 0.0,
            .max = 1e4,
            .origin = Origin::kPublished,
            .source = "Matthies 1995 table 1 (MFEX)"});
    v.Real("gyro_W", gyro_W,
           {.doc = "turn rate sensor",
            .min = 0.0,
            .max = 1e4,
            .origin = Origin::kPublished,
            .source = "Matthies 1995 table 1 (MFEX)"});
    v.Real("accelerometers_W", accelerometers_W,
           {.doc = "accelerometers, while the rover moves and where it has them",
            .min = 0.0,
            .max = 1e4,
            .origin = Origin::kPublished,
            .source = "Matthies 1995 table 1 (MFEX)"});
    v.Real("imaging_W", imaging_W,
           {.doc = "CCDs and clocks, during a scan",
            .min = 0.0,
            .max = 1e4,
            .origin = Origin::kPublished,
            .source = "Matthies 1995 table 1 (MFEX)"});
    v.Real("cmos_imaging_share", cmos_imaging_share,
           {.doc = "power of CMOS imagers over that of CCDs",
            .min = 0.0,
            .max = 10.0,
            .origin = Origin::kPublished,
            .source = "Matthies 1995 sec. 6: potentially a factor of ten for imaging alone"});
    v.Real("laser_supply_efficiency", laser_supply_efficiency,
           {.doc = "electrical power of the lasers over what their voltage conversion draws",
            .min = 0.01,
            .max = 1.0,
            .origin = Origin::kPublished,
            .source = "Matthies 1995 table 3 and sec. 6: 0.66 W each, 2.01 W for two with losses"});
    v.Real("stereo_imaging_W", stereo_imaging_W,
           {.doc = "a pair of stereo cameras while they take images",
            .min = 0.0,
            .max = 1e4,
            .origin = Origin::kAssumed,
            .source = "as the two CCDs of the light stripe sensor (Matthies 1995 table 1)",
            .study_low = 0.5,
            .study_high = 10.0});
    v.Real("computing_W", computing_W,
           {.doc = "drawn beyond cpu_W while the rover computes stereo, map and votes",
            .min = 0.0,
            .max = 1e4,
            .origin = Origin::kAssumed,
            .source = "a computer that draws the same idle and busy; that of the Athena SDM is not "
                      "published",
            .study_low = 0.0,
            .study_high = 10.0});
    v.Real("driving_W", driving_W,
           {.doc = "drive motors in extreme terrain; drawn by every motion and by a stall",
            .min = 0.01,
            .max = 1e4,
            .origin = Origin::kPublished,
            .source = "Matthies 1995 table 1 (MFEX, -40 C, extreme terrain)"});
    v.Real("steering_W", steering_W,
           {.doc = "steering motors",
            .min = 0.0,
            .max = 1e4,
            .origin = Origin::kPublished,
            .source = "Matthies 1995 table 1 (MFEX, -40 C, extreme terrain)"});
    v.Real("battery_wh", battery_wh,
           {.doc = "energy in the batteries at the start",
            .min = 0.01,
            .max = 1e5,
            .origin = Origin::kAssumed,
            .source = "ten times what a nominal run draws; capacity of Rocky 3.2 is not published",
            .study_low = 25.0,
            .study_high = 150.0});
  }
};

}  // namespace rockyard::trial
