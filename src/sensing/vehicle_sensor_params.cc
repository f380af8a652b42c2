#include "sensing/vehicle_sensor_params.h"

namespace rockyard::sensing {
namespace {

using core::Assumed;
using core::Published;

void Enabled(core::FieldVisitor& v, bool& enabled) {
  v.Boolean("enabled", enabled,
            Published("the rover has this sensor: MFEX does, Rocky 3.2 lacks it",
                      "Matthies 1995 sec. 3, 6"));
}

void Latency(core::FieldVisitor& v, std::int64_t& ticks) {
  v.Integer("latency_ticks", ticks,
            Assumed("control ticks from measurement to use",
                    "one computer with a single thread of control polls its sensors in turn",
                    {0, 1000}, {0, 5}));
}

}  // namespace

void ArticulationSensorParams::Visit(core::FieldVisitor& v) {
  Enabled(v, enabled);
  v.Angle("noise_deg", noise_rad,
          Assumed("standard deviation of each joint angle", "about half a step of the converter",
                  {0.0, 30.0}, {0.0, 1.0}));
  v.Angle("resolution_deg", resolution_rad,
          Assumed("step of the measured angle; 0 is continuous", "10 bits over a turn", {0.0, 30.0},
                  {0.09, 1.4}));
  Latency(v, latency_ticks);
}

void AccelerometerParams::Visit(core::FieldVisitor& v) {
  Enabled(v, enabled);
  v.Real("noise_m_s2", noise_m_s2,
         Assumed("standard deviation of the specific force along each axis",
                 "half a degree of tilt in Mars gravity", {0.0, 100.0}, {0.0, 0.2}));
  v.Real("resolution_m_s2", resolution_m_s2,
         Assumed("step of the measured specific force; 0 is continuous", "10 bits over -1 g to 1 g",
                 {0.0, 100.0}, {0.005, 0.08}));
  Latency(v, latency_ticks);
}

void MotorCurrentSensorParams::Visit(core::FieldVisitor& v) {
  Enabled(v, enabled);
  v.Real("noise_A", noise_A,
         Assumed("standard deviation of each motor's current", "half a step of the converter",
                 {0.0, 100.0}, {0.0, 0.005}));
  v.Real("resolution_A", resolution_A,
         Assumed("step of the measured current; 0 is continuous", "8 bits over half an ampere",
                 {0.0, 100.0}, {0.0005, 0.008}));
  Latency(v, latency_ticks);
  v.Real("torque_per_ampere_Nm_A", torque_per_ampere_Nm_A,
         Assumed("torque at the wheel per ampere, gears and their losses included",
                 "8.28 W for six motors in extreme terrain (Matthies 1995 table 1) are 89 mA each "
                 "at 15.5 V; less no_load_A that is 1.4 N m, well below the stall torque",
                 {0.001, 1e4}, {10.0, 40.0}));
  v.Real("no_load_A", no_load_A,
         Assumed("current of a turning motor without load",
                 "a fifth of the current in extreme terrain: cold grease in the gears",
                 {0.0, 100.0}, {0.005, 0.04}));
}

void ContactSensorParams::Visit(core::FieldVisitor& v) {
  Enabled(v, enabled);
  v.Real("min_force_N", min_force_N,
         Assumed("normal force that closes a switch", "a fortieth of the rover's weight on Mars",
                 {0.0, 1e4}, {0.2, 5.0}));
  v.Real(
      "edge_width_m", edge_width_m,
      Assumed("depth of the strips along the edges, from the outline inwards",
              "the rim of the panel and the front face of the chassis box, rounded edges included",
              {0.001, 1.0}, {0.015, 0.06}));
  v.Real("false_probability", false_probability,
         Assumed("chance that a switch reports a touch in a tick without one",
                 "a switch is closed or open", {0.0, 1.0}, {0.0, 1e-5}));
  Latency(v, latency_ticks);
}

void VehicleSensorParams::Visit(core::FieldVisitor& v) {
  v.Group("articulation", articulation, "rocker and bogie angle encoders");
  v.Group("accelerometers", accelerometers, "accelerometers that tell the tilt");
  v.Group("motor_current", motor_current, "currents of the six drive motors");
  v.Group("contact", contact, "switches on the edges of panel and undercarriage");
}

}  // namespace rockyard::sensing
