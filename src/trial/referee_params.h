// When a trial is over, other than by arriving.
#pragma once

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::trial {

struct RefereeParams {
  double tip_over_rad = math::DegToRad(60.0);
  double stall_window_s = 20.0;
  double stall_distance_m = 0.02;
  double stall_turn_rad = math::DegToRad(5.0);
  double high_centre_load = 0.2;
  double no_path_progress_m = 0.25;
  double no_path_distance_m = 4.0;
  double no_path_turn_rad = math::DegToRad(1080.0);
  double time_limit_s = 14400.0;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::trial
