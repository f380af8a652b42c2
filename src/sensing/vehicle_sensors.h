// The sensors of the Pathfinder rover beside the light stripe (Matthies 1995, section 6): joint
// angle encoders, accelerometers, motor currents, contact switches. The world of a drive measures
// with them once an on-board tick; on board the detectors of felt hazards and of a stuck rover, and
// the attitude estimate, live on what they tell.
//
//   angle     = Q(true + N(0, noise))
//   force     = Q(X_RW (dv/dt + g z) + N(0, noise))     per axis; dv/dt over one tick
//   current   = Q(max(0, |torque| / k + I0 + N(0, noise)))   of a motor that is told to turn; a
//               motor at rest, whose gears hold the wheel, gives Q(max(0, N(0, noise)))
//   switch    = a part of its strip was pressed with min_force at any step of the tick, or falsely
//
// Q rounds to the sensor's resolution, k is torque_per_ampere and I0 no_load. Torque is the mean
// over the tick: motors and wires filter what a physics step shows. Each value is reported
// latency_ticks late; before that many ticks have passed since the start, or since operators moved
// the rover, the first value is reported. Noise of tick n comes from substream n of the sensor's
// own stream (kArticulation, kAccelerometer, kMotorCurrent, kContactSwitch), so that a sensor
// shifts no other's noise, whether it is on or off.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "core/random.h"
#include "messages/commands.h"
#include "messages/vehicle_state.h"
#include "rover/rover_params.h"
#include "sensing/vehicle_sensor_params.h"
#include "truth/rover_state.h"

namespace rockyard::sensing {

// Returns the switch that a touch of the rover's body closes, if any. The panel's outline is
// divided by which edge is nearest in proportion to its half length and half width, the front edge
// into thirds.
std::optional<messages::ContactSwitch> SwitchAt(const truth::BodyContact& contact,
                                                const rover::RoverGeometryParams& geometry,
                                                double edge_width_m);

// Hands each value back `delay` pushes later; until then it hands back the first value.
template <typename T>
class DelayLine {
 public:
  explicit DelayLine(std::int64_t delay) : delay_(static_cast<std::size_t>(delay)) {}

  T Push(const T& value) {
    if (delay_ == 0) return value;
    values_.push_back(value);
    T oldest = values_.front();
    if (values_.size() > delay_) values_.pop_front();
    return oldest;
  }

  void Clear() { values_.clear(); }

 private:
  std::size_t delay_;
  std::deque<T> values_;
};

// All sensors of this file, of one trial.
class VehicleSensors {
 public:
  VehicleSensors(const VehicleSensorParams& params, const rover::RoverParams& rover,
                 core::TrialKey key);

  bool any() const { return params_.any(); }

  // Is called once a physics step. It costs nothing where no sensor needs it.
  void Observe(const truth::RoverState& state);

  // Is called once an on-board tick of duration_s > 0, with what the motors were told meanwhile.
  // Ticks are numbered from 0.
  messages::VehicleState Measure(const truth::RoverState& state,
                                 const messages::WheelCommand& command, double duration_s);

  // Is called where operators moved the rover by hand. Forgets what was measured before, also what
  // is still on its way.
  void Restart(const truth::RoverState& state);

 private:
  // Begins the sums and switches of the next tick at `state`.
  void BeginTick(const truth::RoverState& state);
  messages::Articulation MeasureArticulation(const truth::RoverState& state) const;
  math::Vector3 MeasureForce(const truth::RoverState& state, double duration_s);
  messages::PerWheel<double> MeasureCurrents(const truth::RoverState& state,
                                             const messages::WheelCommand& command) const;
  messages::ContactSwitches MeasureContacts() const;
  core::RandomStream Noise(core::Purpose purpose) const;

  VehicleSensorParams params_;
  rover::RoverGeometryParams geometry_;
  double gravity_m_s2_;
  core::TrialKey key_;
  std::int64_t tick_ = 0;

  math::Vector3 last_v_WR_m_s_ = math::Vector3::Zero();
  messages::ContactSwitches pressed_{};  // since the last tick
  messages::PerWheel<double> torque_sum_Nm_{};
  std::int64_t steps_ = 0;  // in the sum

  DelayLine<messages::Articulation> articulation_;
  DelayLine<math::Vector3> force_;
  DelayLine<messages::PerWheel<double>> currents_;
  DelayLine<messages::ContactSwitches> contacts_;
};

}  // namespace rockyard::sensing
