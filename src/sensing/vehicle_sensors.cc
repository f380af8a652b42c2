#include "sensing/vehicle_sensors.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/random.h"

namespace rockyard::sensing {
namespace {

using core::Purpose;
using math::Vector3;
using messages::ContactSwitch;
using messages::kWheelCount;

double Quantized(double value, double resolution) {
  return resolution > 0.0 ? resolution * std::round(value / resolution) : value;
}

// Returns which strip of the panel's edge holds a point, in R; none where the point lies farther in
// than the strip is wide.
std::optional<ContactSwitch> PanelSwitch(const Vector3& p_R, double half_length_m,
                                         double half_width_m, double edge_width_m) {
  const bool near_end = std::abs(p_R.x()) >= half_length_m - edge_width_m;
  const bool near_side = std::abs(p_R.y()) >= half_width_m - edge_width_m;
  if (!near_end && !near_side) return std::nullopt;
  // The diagonals of the panel divide it into its four edges.
  if (std::abs(p_R.x()) / half_length_m < std::abs(p_R.y()) / half_width_m) {
    return p_R.y() > 0.0 ? ContactSwitch::kLeftEdge : ContactSwitch::kRightEdge;
  }
  if (p_R.x() < 0.0) return ContactSwitch::kRearEdge;
  // The front edge has three switches.
  const double third_m = half_width_m / 3.0;
  if (p_R.y() > third_m) return ContactSwitch::kFrontLeft;
  return p_R.y() < -third_m ? ContactSwitch::kFrontRight : ContactSwitch::kFrontCentre;
}

}  // namespace

std::optional<ContactSwitch> SwitchAt(const truth::BodyContact& contact,
                                      const rover::RoverGeometryParams& geometry,
                                      double edge_width_m) {
  switch (contact.part) {
    case truth::BodyPart::kPanelEdge:
      return PanelSwitch(contact.p_RoC_R, 0.5 * geometry.length_m, 0.5 * geometry.width_m,
                         edge_width_m);
    case truth::BodyPart::kBelly:
      // The undercarriage has its switch along the front edge.
      if (contact.p_RoC_R.x() < 0.5 * geometry.belly_length_m - edge_width_m) return std::nullopt;
      return ContactSwitch::kUndercarriage;
    case truth::BodyPart::kRocker:
    case truth::BodyPart::kHub:
    case truth::BodyPart::kWheel:
      break;
  }
  return std::nullopt;
}

VehicleSensors::VehicleSensors(const VehicleSensorParams& params, const rover::RoverParams& rover,
                               core::TrialKey key)
    : params_(params),
      geometry_(rover.geometry),
      gravity_m_s2_(rover.physics.gravity_m_s2),
      key_(key),
      articulation_(params.articulation.latency_ticks),
      force_(params.accelerometers.latency_ticks),
      currents_(params.motor_current.latency_ticks),
      contacts_(params.contact.latency_ticks) {}

core::RandomStream VehicleSensors::Noise(Purpose purpose) const {
  return core::RandomStream(key_, purpose, static_cast<std::uint32_t>(tick_));
}

void VehicleSensors::Observe(const truth::RoverState& state) {
  if (params_.motor_current.enabled) {
    // Motors and wires filter: what is measured is the mean over the tick.
    for (std::size_t i = 0; i < kWheelCount; ++i) torque_sum_Nm_[i] += state.motor_torque_Nm[i];
    ++steps_;
  }
  if (!params_.contact.enabled) return;
  for (const truth::BodyContact& contact : state.contacts) {
    if (contact.normal_force_N < params_.contact.min_force_N) continue;
    const auto pressed = SwitchAt(contact, geometry_, params_.contact.edge_width_m);
    if (pressed) pressed_[messages::Index(*pressed)] = true;
  }
}

messages::VehicleState VehicleSensors::Measure(const truth::RoverState& state,
                                               const messages::WheelCommand& command,
                                               double duration_s) {
  EXPECT(duration_s > 0.0);
  messages::VehicleState measured;
  if (params_.articulation.enabled) {
    // Every value is measured now and handed out latency_ticks later.
    measured.articulation = articulation_.Push(MeasureArticulation(state));
  }
  if (params_.accelerometers.enabled) {
    measured.specific_force_R = force_.Push(MeasureForce(state, duration_s));
  }
  if (params_.motor_current.enabled) {
    measured.motor_current_A = currents_.Push(MeasureCurrents(state, command));
  }
  if (params_.contact.enabled) measured.contact = contacts_.Push(MeasureContacts());
  ++tick_;
  BeginTick(state);
  return measured;
}

void VehicleSensors::Restart(const truth::RoverState& state) {
  BeginTick(state);
  // What was measured before the move must not arrive any more.
  articulation_.Clear();
  force_.Clear();
  currents_.Clear();
  contacts_.Clear();
}

void VehicleSensors::BeginTick(const truth::RoverState& state) {
  last_v_WR_m_s_ = state.v_WR_m_s;
  pressed_.fill(false);
  torque_sum_Nm_.fill(0.0);
  steps_ = 0;
}

messages::Articulation VehicleSensors::MeasureArticulation(const truth::RoverState& state) const {
  // Numbers are drawn in a fixed order, one for each joint.
  core::RandomStream noise = Noise(Purpose::kArticulation);
  const ArticulationSensorParams& params = params_.articulation;
  const auto measure = [&](double true_rad) {
    return Quantized(core::SampleNormal(noise, true_rad, params.noise_rad), params.resolution_rad);
  };
  messages::Articulation measured;
  measured.left_rocker_rad = measure(state.left_rocker_rad);
  measured.right_rocker_rad = measure(state.right_rocker_rad);
  measured.left_bogie_rad = measure(state.left_bogie_rad);
  measured.right_bogie_rad = measure(state.right_bogie_rad);
  return measured;
}

Vector3 VehicleSensors::MeasureForce(const truth::RoverState& state, double duration_s) {
  core::RandomStream noise = Noise(Purpose::kAccelerometer);
  const AccelerometerParams& params = params_.accelerometers;
  // An accelerometer measures the specific force f = dv/dt + g z, which is g upwards at rest. dv/dt
  // is the mean over the tick.
  const Vector3 force_W =
      (state.v_WR_m_s - last_v_WR_m_s_) / duration_s + gravity_m_s2_ * Vector3::UnitZ();
  Vector3 force_R = state.X_WR.linear().transpose() * force_W;
  for (double& axis : force_R) {
    axis = Quantized(core::SampleNormal(noise, axis, params.noise_m_s2), params.resolution_m_s2);
  }
  return force_R;
}

messages::PerWheel<double> VehicleSensors::MeasureCurrents(
    const truth::RoverState& state, const messages::WheelCommand& command) const {
  core::RandomStream noise = Noise(Purpose::kMotorCurrent);
  const MotorCurrentSensorParams& params = params_.motor_current;
  messages::PerWheel<double> measured{};
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    // Drawn also for a motor at rest, so that no command shifts the noise of the next wheel.
    const double error_A = core::SampleNormal(noise, 0.0, params.noise_A);
    const double torque_Nm =
        steps_ > 0 ? torque_sum_Nm_[i] / static_cast<double>(steps_) : state.motor_torque_Nm[i];
    // I = |torque| / k + I0 with k the torque per ampere; the sign of the current is not measured.
    const double true_A =
        command.rate_rad_s[i] == 0.0
            ? 0.0
            : std::abs(torque_Nm) / params.torque_per_ampere_Nm_A + params.no_load_A;
    measured[i] = Quantized(std::max(0.0, true_A + error_A), params.resolution_A);
  }
  return measured;
}

messages::ContactSwitches VehicleSensors::MeasureContacts() const {
  messages::ContactSwitches measured = pressed_;
  if (params_.contact.false_probability > 0.0) {
    core::RandomStream noise = Noise(Purpose::kContactSwitch);
    // A switch that closes without a touch.
    for (bool& pressed : measured) {
      pressed |= core::SampleBernoulli(noise, params_.contact.false_probability);
    }
  }
  return measured;
}

}  // namespace rockyard::sensing
