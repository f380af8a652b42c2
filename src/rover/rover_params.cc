#include "rover/rover_params.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "math/functions.h"
#include "messages/wheels.h"
#include "rover/rover_layout_params.h"

namespace rockyard::rover {

namespace {

using core::Assumed;
using core::Published;
using core::Setting;

// Returns the rim speed up to which motion counts as quasi-static, m/s. Inertia tells against
// weight by the Froude number v^2 / (g r); its bound is that of the comparison in README.md of this
// folder, 0.2 m/s with a wheel of 65 mm in Earth's gravity.
double FastestScaled(const RoverParams& params) {
  constexpr double kSpeed_m_s = 0.2;
  constexpr double kGravityTimesRadius_m2_s2 = 9.81 * 0.065;
  return kSpeed_m_s * std::sqrt(params.physics.gravity_m_s2 * params.geometry.wheel_radius_m /
                                kGravityTimesRadius_m2_s2);
}

// Refuses a quasi-static rover that drives so fast that inertia tells.
void RequireSlowBalances(const RoverParams& params, core::FieldVisitor& v) {
  const double fastest_m_s = FastestScaled(params);
  v.Require("drive.speed_m_s",
            params.fidelity == Fidelity::kMultibody || params.drive.speed_m_s <= fastest_m_s,
            fmt::format("is faster than {:.3g} m/s, from where on inertia, of which fidelity "
                        "quasi_static knows only starts and stops, begins to tell in this gravity "
                        "on these wheels",
                        fastest_m_s),
            "use fidelity multibody, or a slower rover");
}

// Refuses a physics.time_scale with which inertia would tell.
void RequireSlowMotion(const RoverParams& params, core::FieldVisitor& v) {
  const double fastest_m_s = FastestScaled(params);
  const double speed_m_s = params.drive.speed_m_s;
  const double scale = params.physics.time_scale;
  v.Require("physics.time_scale", scale == 1.0 || speed_m_s * scale <= fastest_m_s,
            fmt::format("makes the simulated rims (drive.speed_m_s times physics.time_scale) "
                        "faster than {:.3g} m/s, where inertia begins to tell in this gravity on "
                        "these wheels",
                        fastest_m_s),
            speed_m_s < fastest_m_s
                ? fmt::format("use at most {:.4g}, or 1",
                              std::floor(100.0 * fastest_m_s / speed_m_s) / 100.0)
                : std::string("use 1"));
}

}  // namespace

void QuasiStaticParams::Visit(core::FieldVisitor& v) {
  v.Real("step_s", step_s, Setting("time of one step", {1e-3, 1.0}));
  v.Real("settle_distance_m", settle_distance_m,
         Setting("way between two poses that are settled on the terrain; interpolated between",
                 {1e-3, 0.1}));
  v.Angle("settle_turn_deg", settle_turn_rad,
          Setting("turn between two settled poses", {0.1, 15.0}));
  v.Real("rock_settle_share", rock_settle_share,
         Setting("share of both while a rock or a wall bears a part of the rover, and on soil into "
                 "which wheels take more way to dig than settle_distance_m",
                 {0.05, 1.0}));
}

void RoverMassParams::Visit(core::FieldVisitor& v) {
  v.Real("total_kg", total_kg,
         Published("mass of the rover", "Matthies 1995 sec. 2.1: Rocky 3.2 weighs about 20 kg",
                   {0.5, 2000.0}));
  v.Real("wheel_kg", wheel_kg,
         Assumed("mass of a wheel with its motor", "Rocky 7", {0.05, 100.0}, {0.3, 0.8}));
  v.Real("rocker_kg", rocker_kg,
         Assumed("mass of a rocker, concentrated about its pivot",
                 "structure of about a tenth of the rover", {0.05, 100.0}, {0.4, 1.2}));
  v.Real("bogie_kg", bogie_kg,
         Assumed("mass of a bogie, concentrated about its pivot",
                 "structure of about a tenth of the rover", {0.05, 100.0}, {0.25, 0.8}));
  v.Real("chassis_com_x_m", chassis_com_x_m,
         Assumed("centre of mass of the chassis with what it carries",
                 "equal load on all wheels within a tenth", {-1.0, 1.0}, {-0.03, 0.03}));
  v.Real("chassis_com_z_m", chassis_com_z_m,
         Assumed("height of the centre of mass of the chassis with what it carries",
                 "batteries low in the box, panel and sensors on top (Rocky 7: 0.155)", {0.02, 2.0},
                 {0.155, 0.22}));
  v.Require("total_kg", total_kg > 6.0 * wheel_kg + 2.0 * (rocker_kg + bogie_kg),
            "is less than wheels, rockers and bogies together", "raise it or reduce the parts");
}

void RoverDriveParams::Visit(core::FieldVisitor& v) {
  v.Real("speed_m_s", speed_m_s,
         Published("rim speed of the fastest wheel", "Matthies 1995 sec. 5", {0.001, 1.0}));
  v.Real("ramp_s", ramp_s,
         Assumed("time in which the drive motors come from rest to speed_m_s, or from it to rest, "
                 "at constant acceleration; 0: at once",
                 "not known of Rocky 3.2: between motors that are switched on and off, as MFEX's "
                 "are, and the gentle profiles of later research rovers; the middle of the range",
                 {0.0, 10.0}, {0.0, 0.2}));
  v.Real("stall_torque_Nm", stall_torque_Nm,
         Assumed("largest torque of a drive motor at the wheel",
                 "enough that friction, not the motor, limits a climb of the published 1.5 wheel "
                 "diameters",
                 {0.01, 1000.0}, {2.0, 8.0}));
  v.Angle("steer_rate_deg_s", steer_rate_rad_s,
          Assumed("rate of the steering motors", "a turn in place begins within a second",
                  {1.0, 1000.0}, {20.0, 90.0}));
  v.Angle("max_steer_deg", max_steer_rad,
          Assumed("stop of the steering on either side", "a turn about the chassis centre needs 52",
                  {0.0, 90.0}, {55.0, 70.0}));
}

void RoverContactParams::Visit(core::FieldVisitor& v) {
  v.Real("wheel_rock_friction", wheel_rock_friction,
         Assumed("friction of cleated wheels on rock",
                 "rocker-bogie climbing analyses use 0.5 to 1", {0.0, 3.0}, {0.5, 1.0}));
  v.Real(
      "body_rock_friction", body_rock_friction,
      Assumed("friction of chassis, arms, hubs and panel on rock and ground, and of all on walls",
              "metal on stone", {0.0, 3.0}, {0.2, 0.6}));
  v.Real("stiffness_N_m", stiffness_N_m,
         Assumed("stiffness of each contact", "a wheel at rest sinks in by 0.7 mm", {1e3, 1e8},
                 {2e4, 2e5}));
  v.Real("damping_Ns_m", damping_Ns_m,
         Assumed("damping of each contact", "about critical for a sixth of the rover", {1.0, 1e7},
                 {400.0, 1600.0}));
}

void RoverPhysicsParams::Visit(core::FieldVisitor& v) {
  v.Real("step_s", step_s, Setting("physics step", {1e-4, 0.02}));
  v.Integer("solver_iterations", solver_iterations,
            Setting("sweeps over the constraint rows in each step", {1, 1000}));
  v.Real("gravity_m_s2", gravity_m_s2,
         Setting("gravity; 9.81 on Earth, 3.72 on Mars", {0.1, 30.0}));
  v.Real(
      "time_scale", time_scale,
      Setting(
          "multibody: rates are simulated so many times faster than real, and times and velocities "
          "reported as real; for rovers that drive slowly enough to be at rest along the way",
          {1.0, 1000.0}));
  v.Choice("dynamics", dynamics,
           Setting("multibody: who accelerates the articulated body; bullet: btMultiBody, within "
                   "rounding the same, a third slower and with other bits on other processors"));
}

void RoverParams::Visit(core::FieldVisitor& v) {
  v.Choice("fidelity", fidelity,
           Setting("multibody: articulated dynamics in steps of physics.step_s; quasi_static: "
                   "poses at rest along the way, some fifteen times cheaper"));
  v.Group("geometry", geometry, "dimensions");
  v.Group("mass", mass, "masses");
  v.Group("drive", drive, "drive and steering motors");
  v.Group("contact", contact, "wheels and body against soil and rock");
  v.Group("physics", physics, "gravity and numerical solution");
  RequireSlowMotion(*this, v);
  RequireSlowBalances(*this, v);
  v.Group("quasi_static", quasi_static, "fidelity quasi_static: step and resolution");
}

messages::PerWheel<double> StaticWheelLoads(const RoverParams& params) {
  const double g = params.physics.gravity_m_s2;
  const RoverMasses masses = MakeRoverMasses(params);
  const RoverGeometry geometry = MakeRoverGeometry(params.geometry);
  // All x are in frame R, for the left side; the right side carries the same.
  const std::size_t on_rocker = geometry.on_bogie[0] ? 2 : 0;  // of the left wheels
  const std::size_t bogie_end = 2 - on_rocker;
  const double rocker_wheel_x = geometry.wheel_R[on_rocker].x();
  const double bogie_x = geometry.bogie_pivot_R[0].x();

  // Free body of one side's rocker with its wheel, held up by the bogie pivot at x_b and by the
  // ground under the rocker's wheel at x_r. The differential passes half of the chassis' weight and
  // of its moment on to each side, so moments about the bogie pivot give
  //   N_r (x_r - x_b) = sum_i W_i (x_i - x_b),   i = half chassis, rocker, wheel.
  const double half_chassis_N = 0.5 * masses.chassis.mass_kg * g;
  const double rocker_N = masses.rocker.mass_kg * g;
  const double wheel_N = masses.wheel.mass_kg * g;
  const double carried_N = half_chassis_N + rocker_N + wheel_N;
  const double moment_Nm = half_chassis_N * (masses.chassis.com_B.x() - bogie_x) +
                           rocker_N * (geometry.rocker_pivot_R[0].x() - bogie_x) +
                           wheel_N * (rocker_wheel_x - bogie_x);
  const double rocker_wheel_N = moment_Nm / (rocker_wheel_x - bogie_x);
  // The pivot carries the rest; with the bogie's own weight, which acts at the pivot, the lever
  // between middle and end wheel divides it:
  //   N_m - W_wheel = B (x_b - x_e) / (x_m - x_e),   N_e - W_wheel = B - (N_m - W_wheel).
  const double bogie_N = carried_N - rocker_wheel_N + masses.bogie.mass_kg * g;
  const double middle_x = geometry.wheel_R[1].x();
  const double end_x = geometry.wheel_R[bogie_end].x();
  const double middle_share = (bogie_x - end_x) / (middle_x - end_x);

  messages::PerWheel<double> load_N{};
  // Wheels of the left side begin at 0, those of the right at 3.
  for (const std::size_t side : {0, 3}) {
    load_N[side + on_rocker] = rocker_wheel_N;
    load_N[side + 1] = middle_share * bogie_N + wheel_N;
    load_N[side + bogie_end] = (1.0 - middle_share) * bogie_N + wheel_N;
  }
  return load_N;
}

// Loads N are linear in the position x, so that the load of a wheel is zero at
// x = N(0) / (N(0) - N(1 m)).
ComRange StandingComRange(const RoverParams& params) {
  const auto loads_at = [&params](double com_x_m) {
    RoverParams moved = params;
    moved.mass.chassis_com_x_m = com_x_m;
    return StaticWheelLoads(moved);
  };
  const messages::PerWheel<double> at_origin_N = loads_at(0.0);
  const messages::PerWheel<double> at_metre_N = loads_at(1.0);
  constexpr double kFar_m = std::numeric_limits<double>::infinity();
  ComRange range{-kFar_m, kFar_m};
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const double gain_N = at_metre_N[i] - at_origin_N[i];
    const double zero_m = -at_origin_N[i] / gain_N;
    if (gain_N > 0.0) range.min_m = std::max(range.min_m, zero_m);
    if (gain_N < 0.0) range.max_m = std::min(range.max_m, zero_m);
  }
  return range;
}

WheelOnSoil MakeWheelOnSoil(const RoverParams& params, const terrain::SoilParams& soil) {
  const WheelOnSoil::Case of{soil, RimShapeOf(params.geometry), params.physics.gravity_m_s2,
                             params.mass.total_kg * params.physics.gravity_m_s2};
  if (params.made_wheel != nullptr && params.made_wheel->of() == of) return *params.made_wheel;
  return WheelOnSoil(of);
}

double SteepestHeldSlope_rad(const RoverParams& params, const terrain::SoilParams& soil) {
  const WheelOnSoil wheel = MakeWheelOnSoil(params, soil);
  const double level_N = params.mass.total_kg * params.physics.gravity_m_s2 /
                         static_cast<double>(messages::kWheelCount);
  // The pull grows with the slope and what the soil bears shrinks with the load, so that their
  // difference has one root. The interval is halved until no number lies between its ends.
  double held_rad = 0.0;
  double slides_rad = 0.5 * std::numbers::pi;
  for (int i = 0; i < 60; ++i) {
    const double slope_rad = 0.5 * (held_rad + slides_rad);
    const double bears_N = wheel.Under(level_N * math::Cos(slope_rad), 0.0).traction_N;
    (level_N * math::Sin(slope_rad) <= bears_N ? held_rad : slides_rad) = slope_rad;
  }
  return held_rad;
}

}  // namespace rockyard::rover
