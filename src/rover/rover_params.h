// Parameters of the six-wheel rocker-bogie rover, and what follows from them by statics. Drives and
// the command `rover` take them; checks of a drive ask whether such a rover stands and is held on
// its slope. The defaults describe Rocky 3.2. Records and baselines depend on a default in every
// scenario that leaves its parameter out; a bound only refuses files. Meanings and sources stand in
// the .cc.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"
#include "messages/wheels.h"
#include "rover/rover_geometry_params.h"
#include "rover/wheel_law_params.h"
#include "terrain/soil_params.h"

namespace rockyard::rover {

// Fidelity quasi_static: the step at which the state is reported, and how far the wheels travel
// between two balances.
struct QuasiStaticParams {
  double step_s = 0.05;
  double settle_distance_m = 0.02;
  double settle_turn_rad = math::DegToRad(3.0);
  double rock_settle_share = 0.5;

  void Visit(core::FieldVisitor& v);
};

// How the rover's motion is computed.
enum class Fidelity { kMultibody, kQuasiStatic };

struct RoverMassParams {
  double total_kg = 20.0;
  double wheel_kg = 0.5;
  double rocker_kg = 0.8;
  double bogie_kg = 0.5;
  double chassis_com_x_m = 0.0;
  double chassis_com_z_m = 0.19;

  void Visit(core::FieldVisitor& v);
};

struct RoverDriveParams {
  double speed_m_s = 0.15;
  double ramp_s = 0.1;
  double stall_torque_Nm = 4.0;
  double steer_rate_rad_s = math::DegToRad(60.0);
  double max_steer_rad = math::DegToRad(60.0);

  void Visit(core::FieldVisitor& v);
};

struct RoverContactParams {
  double wheel_rock_friction = 0.8;
  double body_rock_friction = 0.4;
  double stiffness_N_m = 5e4;
  double damping_Ns_m = 800.0;

  void Visit(core::FieldVisitor& v);
};

// Whose accelerations of the articulated body the multibody takes.
enum class Dynamics { kRockyard, kBullet };

struct RoverPhysicsParams {
  double step_s = 1.0 / 60.0;
  std::int64_t solver_iterations = 10;
  double gravity_m_s2 = 9.81;
  double time_scale = 1.0;
  Dynamics dynamics = Dynamics::kRockyard;

  void Visit(core::FieldVisitor& v);
};

struct RoverParams {
  Fidelity fidelity = Fidelity::kMultibody;
  RoverGeometryParams geometry{};
  RoverMassParams mass{};
  RoverDriveParams drive{};
  RoverContactParams contact{};
  RoverPhysicsParams physics{};
  QuasiStaticParams quasi_static{};
  // No parameter: what MakeWheelOnSoil returns where it was made for the same case beforehand, so
  // that all trials of a scenario share one table.
  std::shared_ptr<const WheelOnSoil> made_wheel{};

  void Visit(core::FieldVisitor& v);
};

// Returns what each wheel carries on level ground at rest, N, by the law of the lever. Each side
// carries half of the chassis, whose moment the differential passes on to both rockers alike;
// moments about the bogie pivot give the load of the wheel on the rocker, and the bogie's wheels
// share the rest as their levers do. The loads are exact where wheels have no friction along the
// ground; with friction the loads of a rover at rest also depend on how it came there. A negative
// load means that the rover cannot stand.
messages::PerWheel<double> StaticWheelLoads(const RoverParams& params);

// An open interval along x of R, m.
struct ComRange {
  double min_m;
  double max_m;
};

// Returns the values of mass.chassis_com_x_m with which every wheel carries something; the value in
// `params` does not matter.
ComRange StandingComRange(const RoverParams& params);

// Returns what the soil does to a wheel of the rover, for loads up to its weight. A law of stresses
// takes 0.2 ms, unless made_wheel is of the same case.
WheelOnSoil MakeWheelOnSoil(const RoverParams& params, const terrain::SoilParams& soil);

// Returns the inclination in [0, pi/2] at which the pull down the slope reaches what the soil bears
// across a braked wheel, whatever the rover's heading:
//   tan(slope) = T_max(N) / N,   N = W cos(slope) / 6,
// with each wheel under the mean load (T_max: wheel_law_params.h). Wheels that point up or down the
// slope hold more, by their resistance R.
double SteepestHeldSlope_rad(const RoverParams& params, const terrain::SoilParams& soil);

}  // namespace rockyard::rover

template <>
struct rockyard::core::EnumNames<rockyard::rover::Dynamics> {
  static constexpr std::array<std::string_view, 2> kNames{"rockyard", "bullet"};
};

template <>
struct rockyard::core::EnumNames<rockyard::rover::Fidelity> {
  static constexpr std::array<std::string_view, 2> kNames{"multibody", "quasi_static"};
};
