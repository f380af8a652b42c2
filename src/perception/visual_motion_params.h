// Parameters of what on-board software makes of motions that it sees.
#pragma once

#include "core/fields.h"
#include "math/angles.h"
#include "vision/odometry/odometer_params.h"

namespace rockyard::perception {

struct SlipCheckParams {
  bool enabled = false;
  double limit = 0.5;
  double sigma = 2.0;
  double min_way_m = 0.2;

  void Visit(core::FieldVisitor& v);
};

struct VisualMotionParams {
  double tilt_sd_rad = math::DegToRad(1.0);
  SlipCheckParams slip_check;
  vision::OdometerParams odometer;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::perception
