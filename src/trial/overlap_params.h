// What a rover may do at once.
#pragma once

#include "core/fields.h"

namespace rockyard::trial {

// Without any of it one activity goes on at a time (Matthies 1995, section 2.1.2).
struct OverlapParams {
  bool imaging = false;
  bool computing = false;
  bool steering = false;

  void Visit(core::FieldVisitor& v) {
    using core::Origin;
    v.Boolean(
        "imaging", imaging,
        {.doc = "images of terrain are taken while the rover drives or computes, of the place "
                "where it is then; else it stops for them. For navigators that ask for it "
                "(gestalt with continuous.cycle csod or csad); a light stripe scan always stops "
                "the rover",
         .origin = Origin::kSetting});
    v.Boolean("computing", computing,
              {.doc = "looks are computed while the rover drives or takes images; else it stops "
                      "until they are. For navigators that ask for it, as imaging",
               .origin = Origin::kSetting});
    v.Boolean(
        "steering", steering,
        {.doc = "the wheels roll while they are steered, however far, but for the change between "
                "arcs and turns in place, and the steering motors draw their power beside the "
                "drive motors; else navigation.wheel_driver.steer_while_driving_deg says when the "
                "rover stands to steer, and what is steered while it drives draws nothing",
         .origin = Origin::kSetting});
  }
};

}  // namespace rockyard::trial
