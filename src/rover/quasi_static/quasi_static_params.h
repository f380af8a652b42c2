// Resolution of the quasi-static rover.
#pragma once

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::rover {

// The step at which the state is reported, and how far the wheels travel between two balances.
struct QuasiStaticParams {
  double step_s = 0.05;
  double settle_distance_m = 0.02;
  double settle_turn_rad = math::DegToRad(3.0);
  double rock_settle_share = 0.5;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::rover
