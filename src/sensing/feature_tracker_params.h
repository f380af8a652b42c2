// Parameters of the sensor that follows a feature which the rover is to drive to.
#pragma once

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::sensing {

struct FeatureTrackerParams {
  bool enabled = false;
  double range_m = 5.0;
  double half_field_of_view_rad = math::DegToRad(45.0);
  double bearing_sd_rad = math::DegToRad(0.5);
  double range_sd_fraction = 0.02;
  double period_s = 1.0;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::sensing
