// Electrical power by activity and the batteries.
#pragma once

#include "core/fields.h"

namespace rockyard::trial {

struct EnergyParams {
  double hazard_detection_W = 7.33;
  double cpu_W = 3.77;
  double gyro_W = 0.80;
  double driving_W = 8.28;
  double steering_W = 6.70;
  double battery_wh = 50.0;

  void Visit(core::FieldVisitor& v) {
    using core::Origin;
    v.Real("hazard_detection_W", hazard_detection_W,
           {.doc = "power during a hazard scan, computer included",
            .min = 0.0,
            .max = 1e4,
            .origin = Origin::kPublished,
            .source = "Matthies 1995 sec. 6 (MFEX)"});
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
