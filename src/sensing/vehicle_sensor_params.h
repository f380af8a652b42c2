// Parameters of the sensors by which the Pathfinder rover feels what it stands on and what it
// touches (Matthies 1995, section 6; scenario group sensors.vehicle). The sensors of
// vehicle_sensors.h read them. All are off by default, as Rocky 3.2 lacked them; where one is on,
// defaults decide records. The paper gives no numbers beyond the accelerometers' power, so every
// value is assumed.
//
// Every sensor but the contact switches has measured = quantized(true + N(0, noise)); every sensor
// reports latency_ticks late.
#pragma once

#include <cstdint>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::sensing {

struct ArticulationSensorParams {
  bool enabled = false;
  double noise_rad = math::DegToRad(0.2);
  double resolution_rad = math::DegToRad(0.35);
  std::int64_t latency_ticks = 1;

  void Visit(core::FieldVisitor& v);
};

struct AccelerometerParams {
  bool enabled = false;
  double noise_m_s2 = 0.03;
  double resolution_m_s2 = 0.02;
  std::int64_t latency_ticks = 1;

  void Visit(core::FieldVisitor& v);
};

struct MotorCurrentSensorParams {
  bool enabled = false;
  double noise_A = 0.001;
  double resolution_A = 0.002;
  std::int64_t latency_ticks = 1;
  double torque_per_ampere_Nm_A = 20.0;
  double no_load_A = 0.02;

  void Visit(core::FieldVisitor& v);
};

struct ContactSensorParams {
  bool enabled = false;
  double min_force_N = 1.0;
  double edge_width_m = 0.03;
  double false_probability = 0.0;
  std::int64_t latency_ticks = 1;

  void Visit(core::FieldVisitor& v);
};

struct VehicleSensorParams {
  ArticulationSensorParams articulation{};
  AccelerometerParams accelerometers{};
  MotorCurrentSensorParams motor_current{};
  ContactSensorParams contact{};

  bool any() const {
    return articulation.enabled || accelerometers.enabled || motor_current.enabled ||
           contact.enabled;
  }

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::sensing
