// What the lander's stereo pair shows of the rocks (Matthies 1995, sections 2.1.1 and 4).
#pragma once

#include "core/fields.h"

namespace rockyard::trial {

// The cameras themselves, and where they stand, are those that designate goals
// (designation_params.h): angle of a pixel, baseline, pan error.
struct LanderMapParams {
  double mast_height_m = 1.5;
  double edge_sd_px = 1.0;
  double disparity_sd_px = 0.1;
  double resolved_px = 3.0;
  double reach_m = 40.0;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::trial
