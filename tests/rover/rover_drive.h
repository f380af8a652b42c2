// Wheel commands and terrains for tests of the rover.
#pragma once

#include <cmath>

#include "core/hash.h"
#include "messages/commands.h"
#include "rover/rover.h"
#include "rover/rover_layout_params.h"
#include "rover/soil_reference.h"
#include "terrain/terrain.h"

namespace rockyard::rover {

inline constexpr messages::WheelCommand kBraked{};

// Wheel set points for the planar motion with forward speed v at R's origin and turn rate w.
inline messages::WheelCommand Drive(const RoverParams& params, double v_m_s, double w_rad_s) {
  const RoverGeometry geometry = MakeRoverGeometry(params.geometry);
  messages::WheelCommand command;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const double vx = v_m_s - w_rad_s * geometry.wheel_R[i].y();
    const double vy = w_rad_s * geometry.wheel_R[i].x();
    double steer = 0.0;
    double rim = vx;
    if (geometry.steered[i]) {
      const double sign = vx < 0.0 ? -1.0 : 1.0;
      steer = std::atan2(sign * vy, sign * vx);
      rim = sign * std::hypot(vx, vy);
    }
    command.steer_rad[i] = steer;
    command.rate_rad_s[i] = rim / params.geometry.wheel_radius_m;
  }
  return command;
}

// The same with all wheels stopped: lets the steering arrive.
inline messages::WheelCommand SteerOnly(messages::WheelCommand command) {
  command.rate_rad_s.fill(0.0);
  return command;
}

inline RoverParams WithFidelity(Fidelity fidelity) { return RoverParams{.fidelity = fidelity}; }

// Of pose and wheel angles, to tell whether two drives are the same.
inline std::string StateHash(const truth::RoverState& state) {
  core::Hasher hasher;
  for (const double value : state.X_WR.matrix().reshaped()) hasher.Real(value);
  for (const double angle : state.wheel_angle_rad) hasher.Real(angle);
  return core::Hex(hasher.value());
}

// A rover that has been placed, at the origin unless told otherwise.
inline std::unique_ptr<Rover> PlacedRover(const RoverParams& params,
                                          const terrain::Terrain& terrain,
                                          const math::Pose2& X_WR = {}) {
  auto rover = MakeRover(params, terrain);
  rover->Place(X_WR);
  return rover;
}

// The same with a terrain of its own.
class RoverOn {
 public:
  explicit RoverOn(terrain::Terrain terrain, const RoverParams& params = {},
                   const math::Pose2& X_WR = {})
      : terrain_(std::make_unique<terrain::Terrain>(std::move(terrain))),
        rover_(PlacedRover(params, *terrain_, X_WR)) {}

  Rover* operator->() const { return rover_.get(); }
  Rover& operator*() const { return *rover_; }

 private:
  std::unique_ptr<terrain::Terrain> terrain_;
  std::unique_ptr<Rover> rover_;
};

inline terrain::Terrain FlatTerrain(std::vector<terrain::Rock> rocks = {},
                                    std::vector<terrain::Wall> walls = {}) {
  return {terrain::Ground({.soil = BekkerSoil()}, {}), std::move(rocks), std::move(walls)};
}

inline terrain::Terrain SlopeTerrain(double slope_rad, double direction_rad,
                                     const terrain::SoilParams& soil = BekkerSoil()) {
  terrain::GroundParams params{
      .slope_rad = slope_rad, .slope_direction_rad = direction_rad, .soil = soil};
  return {terrain::Ground(params, {}), {}, {}};
}

// Coulomb friction without slip, sinkage of 0.1 um and a drag of 0.0005 of the load.
inline terrain::SoilParams RigidGround(double friction) {
  terrain::SoilParams soil = terrain::MakeSoil(terrain::SoilPreset::kHardGround);
  soil.frictional_modulus_N_per_mn2 = 1e14;
  soil.friction_angle_rad = std::atan(friction);
  return soil;
}

// An ellipsoid with its centre at the given height.
inline terrain::Rock MakeRock(double x_m, double y_m, double center_z_m, double a_m, double b_m,
                              double c_m) {
  return terrain::Rock{.center_W = math::Vector3(x_m, y_m, center_z_m),
                       .semi_axes_m = math::Vector3(a_m, b_m, c_m),
                       .diameter_m = 2.0 * a_m,
                       .height_m = center_z_m + c_m};
}

// A vertical step across the way, `deep_m` along it from x = 0.6 on: flat ellipsoids stacked so
// densely that a wheel meets a wall with ripples of 0.1 mm and a sharp upper edge `edge_m` below
// the flat top.
inline std::vector<terrain::Rock> StepRocks(double height_m, double edge_m = 0.01,
                                            double deep_m = 1.2) {
  std::vector<terrain::Rock> rocks;
  for (double z = height_m - edge_m; z > 0.0; z -= 0.6 * edge_m) {
    rocks.push_back(MakeRock(0.6 + 0.5 * deep_m, 0.0, z, 0.5 * deep_m, 2.0, edge_m));
  }
  return rocks;
}
inline terrain::Terrain StepTerrain(double height_m, const terrain::SoilParams& soil = BekkerSoil(),
                                    double edge_m = 0.01, double deep_m = 1.2) {
  return {terrain::Ground({.soil = soil}, {}), StepRocks(height_m, edge_m, deep_m), {}};
}

inline void RunFor(Rover& rover, const messages::WheelCommand& command, double time_s) {
  const int steps = static_cast<int>(std::lround(time_s / rover.step_s()));
  for (int i = 0; i < steps; ++i) rover.Step(command);
}

inline double Pitch(const math::Transform& X_WR) { return -std::asin(X_WR.linear()(2, 0)); }

// Weights of all parts and where their common centre of mass is, in R.
struct Weights {
  double chassis_N, rocker_N, bogie_N, wheel_N, total_N, com_x_m, com_z_m;

  explicit Weights(const RoverParams& p) {
    const double g = p.physics.gravity_m_s2;
    rocker_N = p.mass.rocker_kg * g;
    bogie_N = p.mass.bogie_kg * g;
    wheel_N = p.mass.wheel_kg * g;
    total_N = p.mass.total_kg * g;
    chassis_N = total_N - 2.0 * (rocker_N + bogie_N) - 6.0 * wheel_N;
    const RoverGeometry geometry = MakeRoverGeometry(p.geometry);
    math::Vector3 moment_Nm =
        chassis_N * math::Vector3(p.mass.chassis_com_x_m, 0.0, p.mass.chassis_com_z_m);
    for (const math::Vector3& pivot_R : geometry.rocker_pivot_R) moment_Nm += rocker_N * pivot_R;
    for (const math::Vector3& pivot_R : geometry.bogie_pivot_R) moment_Nm += bogie_N * pivot_R;
    for (const math::Vector3& wheel_R : geometry.wheel_R) moment_Nm += wheel_N * wheel_R;
    com_x_m = moment_Nm.x() / total_N;
    com_z_m = moment_Nm.z() / total_N;
  }
};

// Slip, torques and sinkage of a steady climb.
struct SlopeClimb {
  double slip = 0.0;
  double torque_Nm = 0.0;  // of all wheels
  double sinkage_m = 0.0;  // mean
  messages::PerWheel<double> load_N{};
};

inline SlopeClimb SteadyClimb(const RoverParams& params, double slope_deg,
                              const terrain::SoilParams& soil, double first_s = 12.0) {
  const RoverOn rover(SlopeTerrain(math::DegToRad(slope_deg), 0.0, soil), params);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  RunFor(*rover, command, first_s);
  const math::Vector3 from = rover->state().X_WR.translation();
  RunFor(*rover, command, 4.0);
  const truth::RoverState& state = rover->state();
  SlopeClimb climb{.load_N = state.wheel_load_N};
  climb.slip = 1.0 - (state.X_WR.translation() - from).norm() / 0.6;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    climb.torque_Nm += state.motor_torque_Nm[i];
    climb.sinkage_m += state.wheel_sinkage_m[i] / 6.0;
  }
  return climb;
}

}  // namespace rockyard::rover
