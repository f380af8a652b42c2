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

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::trial
