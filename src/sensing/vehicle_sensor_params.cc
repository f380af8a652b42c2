#include "sensing/vehicle_sensor_params.h"

namespace rockyard::sensing {
namespace {

using core::Origin;

void Enabled(core::FieldVisitor& v, bool& enabled) {
  v.Boolean("enabled", enabled,
            {.doc = "the rover has this sensor: MFEX does, Rocky 3.2 lacks it",
             .origin = Origin::kPublished,
             .source = "Matthies 1995 sec. 3, 6"});
}

void Latency(core::FieldVisitor& v, std::int64_t& ticks) {
  v.Integer("latency_ticks", ticks,
            {.doc = "control ticks from measurement to use",
             .min = 0,
             .max = 1000,
             .origin = Origin::kAssumed,
             .source = "one computer with a single thread of control polls its sensors in turn",
             .study_low = 0,
             .study_high = 5});
}

}  // namespace

void ArticulationSensorParams::Visit(core::FieldVisitor& v) {
  Enabled(v, enabled);
  v.Angle("noise_deg", noise_rad,
          {.doc = "standard deviation of each joint angle",
           .min = 0.0,
           .max = 30.0,
           .origin = Origin::kAssumed,
           .source = "about half a step of the converter",
           .study_low = 0.0,
           .study_high = 1.0});
  v.Angle("resolution_deg", resolution_rad,
          {.doc = "step of the measured angle; 0 is continuous",
           .min = 0.0,
           .max = 30.0,
           .origin = Origin::kAssumed,
           .source = "10 bits over a turn",
           .study_low = 0.09,
           .study_high = 1.4});
  Latency(v, latency_ticks);
}

void AccelerometerParams::Visit(core::FieldVisitor& v) {
  Enabled(v, enabled);
  v.Real("noise_m_s2", noise_m_s2,
         {.doc = "standard deviation of the specific force along each axis",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "half a degree of tilt in Mars gravity",
          .study_low = 0.0,
          .study_high = 0.2});
  v.Real("resolution_m_s2", resolution_m_s2,
         {.doc = "step of the measured specific force; 0 is continuous",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "10 bits over -1 g to 1 g",
          .study_low = 0.005,
          .study_high = 0.08});
  Latency(v, latency_ticks);
}

void MotorCurrentSensorParams::Visit(core::FieldVisitor& v) {
  Enabled(v, enabled);
  v.Real("noise_A", noise_A,
         {.doc = "standard deviation of each motor's current",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "half a step of the converter",
          .study_low = 0.0,
          .study_high = 0.005});
  v.Real("resolution_A", resolution_A,
         {.doc = "step of the measured current; 0 is continuous",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "8 bits over half an ampere",
          .study_low = 0.0005,
          .study_high = 0.008});
  Latency(v, latency_ticks);
  v.Real(
      "torque_per_ampere_Nm_A", torque_per_ampere_Nm_A,
      {.doc = "torque at the wheel per ampere, gears and their losses included",
       .min = 0.001,
       .max = 1e4,
       .origin = Origin::kAssumed,
       .source = "8.28 W for six motors in extreme terrain (Matthies 1995 table 1) are 89 mA each "
                 "at 15.5 V; less no_load_A that is 1.4 N m, well below the stall torque",
       .study_low = 10.0,
       .study_high = 40.0});
  v.Real("no_load_A", no_load_A,
         {.doc = "current of a turning motor without load",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "a fifth of the current in extreme terrain: cold grease in the gears",
          .study_low = 0.005,
          .study_high = 0.04});
}

void ContactSensorParams::Visit(core::FieldVisitor& v) {
  Enabled(v, enabled);
  v.Real("min_force_N", min_force_N,
         {.doc = "normal force that closes a switch",
          .min = 0.0,
          .max = 1e4,
          .origin = Origin::kAssumed,
          .source = "a fortieth of the rover's weight on Mars",
          .study_low = 0.2,
          .study_high = 5.0});
  v.Real("edge_width_m", edge_width_m,
         {.doc = "depth of the strips along the edges, from the outline inwards",
          .min = 0.001,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "the rim of the panel and the front face of the chassis box, rounded edges "
                    "included",
          .study_low = 0.015,
          .study_high = 0.06});
  v.Real("false_probability", false_probability,
         {.doc = "chance that a switch reports a touch in a tick without one",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "a switch is closed or open",
          .study_low = 0.0,
          .study_high = 1e-5});
  Latency(v, latency_ticks);
}

void VehicleSensorParams::Visit(core::FieldVisitor& v) {
  v.Group("articulation", articulation, "rocker and bogie angle encoders");
  v.Group("accelerometers", accelerometers, "accelerometers that tell the tilt");
  v.Group("motor_current", motor_current, "currents of the six drive motors");
  v.Group("contact", contact, "switches on the edges of panel and undercarriage");
}

}  // namespace rockyard::sensing
