// Wheel loads of a rover that drives steadily over soil, on level ground and on slopes, against the
// lever rules of the rocker-bogie.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>

#include "rover_drive.h"
#include "soil_reference.h"

namespace rockyard::rover {
namespace {

using messages::PerWheel;

// One side of the rover, moments (x force_z - z force_x) about its rocker pivot P, bogie pivot B.
// Wheel i, weight w, bears load N_i, pulls with T_i at the ground and is held back by R_i at the
// axle. The ground falls towards -x with the angle a; g_n = cos(a), g_t = sin(a).
//   sum (x_i - x_P)(N_i - w g_n) + z_P T_i + (r - z_P)(R_i + w g_t)
//     - (x_B - x_P) w_B g_n + (z_B - z_P) w_B g_t + M = 0              rocker, bogie and wheels
//   sum over the bogie: (x_i - x_B)(N_i - w g_n) + z_B T_i + (r - z_B)(R_i + w g_t) = 0
//   sum N_i = load of the side
// with the moment M of the chassis, half of what its weight has about the pivots, through the
// differential on either side.
struct Side {
  explicit Side(const RoverParams& rover) : params(rover), weights(rover) {}

  Eigen::Vector3d Loads(double side_load_N, double angle_rad, const Eigen::Vector3d& pull_N,
                        const Eigen::Vector3d& drag_N) const {
    const RoverGeometry g = MakeRoverGeometry(params.geometry);
    const math::Vector3 P = g.rocker_pivot_R[0];
    const math::Vector3 B = g.bogie_pivot_R[0];
    const double gn = std::cos(angle_rad);
    const double gt = std::sin(angle_rad);
    const double r = params.geometry.wheel_radius_m;
    const Weights& w = weights;
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    const double chassis_Nm = -(params.mass.chassis_com_x_m - P.x()) * w.chassis_N * gn +
                              (params.mass.chassis_com_z_m - P.z()) * w.chassis_N * gt;
    b[0] = (B.x() - P.x()) * w.bogie_N * gn - (B.z() - P.z()) * w.bogie_N * gt - 0.5 * chassis_Nm;
    for (int i = 0; i < 3; ++i) {
      const auto wheel = static_cast<std::size_t>(i);
      const double x = g.wheel_R[wheel].x();
      const double back_N = drag_N[i] + w.wheel_N * gt;
      A(0, i) = x - P.x();
      b[0] += (x - P.x()) * w.wheel_N * gn - P.z() * pull_N[i] - (r - P.z()) * back_N;
      A(2, i) = 1.0;
      if (!g.on_bogie[wheel]) continue;
      A(1, i) = x - B.x();
      b[1] += (x - B.x()) * w.wheel_N * gn - B.z() * pull_N[i] - (r - B.z()) * back_N;
    }
    b[2] = side_load_N;
    return A.inverse() * b;
  }

  // Pull and drag of the wheels follow from their loads and one slip for all, the loads from them.
  PerWheel<double> OnPitchSlope(double angle_rad) const {
    const SoilReference soil;
    const double half_N = 0.5 * weights.total_N;
    PerWheel<double> loads_N;
    loads_N.fill(half_N / 3.0);
    for (int round = 0; round < 10; ++round) {
      const double slip = soil.SlipForPull(
          2.0 * half_N * std::sin(angle_rad) + soil.SumResistance(loads_N), loads_N);
      Eigen::Vector3d pull_N, drag_N;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        pull_N[row] = soil.Share(slip, loads_N[i]) * soil.LargestTraction(loads_N[i]);
        drag_N[row] = soil.Resistance(loads_N[i]);
      }
      const Eigen::Vector3d side = Loads(half_N * std::cos(angle_rad), angle_rad, pull_N, drag_N);
      for (std::size_t i = 0; i < 6; ++i) loads_N[i] = side[static_cast<Eigen::Index>(i % 3)];
    }
    return loads_N;
  }

  RoverParams params;
  Weights weights;
};

PerWheel<double> LoadsAfterDriving(const RoverParams& params, const terrain::Terrain& terrain) {
  const auto rover = PlacedRover(params, terrain);
  RunFor(*rover, Drive(params, 0.1, 0.0), 4.0);
  return rover->state().wheel_load_N;
}

// Uphill, level and downhill; bogies in front or behind.
TEST(StaticLoads, PitchSlope) {
  for (const BogieEnd end : {BogieEnd::kFront, BogieEnd::kRear}) {
    for (const double slope_deg : {-15.0, 0.0, 8.0, 15.0}) {
      RoverParams params{.geometry = {.bogie_end = end}, .mass = {.chassis_com_x_m = 0.02}};
      const double slope = math::DegToRad(slope_deg);
      const terrain::Terrain terrain =
          SlopeTerrain(std::abs(slope), slope < 0.0 ? std::numbers::pi : 0.0);
      const PerWheel<double> expected_N = Side(params).OnPitchSlope(slope);
      const PerWheel<double> loads_N = LoadsAfterDriving(params, terrain);
      for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
        EXPECT_NEAR(loads_N[i], expected_N[i], 0.25) << "slope " << slope_deg << ", wheel " << i;
      }
    }
  }
}

// Along a contour the lower side carries W sin(a) z_com / track more than its half, the upper side
// as much less, the track being the distance of the wheels' middles.
TEST(StaticLoads, RollSlope) {
  for (const double slope_deg : {5.0, 10.0}) {
    const RoverParams params;
    const double slope = math::DegToRad(slope_deg);
    const Weights w(params);
    const PerWheel<double> loads_N =
        LoadsAfterDriving(params, SlopeTerrain(slope, 0.5 * std::numbers::pi));
    const double track_m = params.geometry.width_m - params.geometry.wheel_width_m;
    const double shift_N = w.total_N * std::sin(slope) * w.com_z_m / track_m;
    const double half_N = 0.5 * w.total_N * std::cos(slope);
    EXPECT_NEAR(loads_N[0] + loads_N[1] + loads_N[2], half_N - shift_N, 0.01 * half_N);
    EXPECT_NEAR(loads_N[3] + loads_N[4] + loads_N[5], half_N + shift_N, 0.01 * half_N);
    // The differential lets either side share out its load by the same levers.
    for (const std::size_t side : {0U, 3U}) {
      const double side_N = loads_N[side] + loads_N[side + 1] + loads_N[side + 2];
      Eigen::Vector3d drag_N;
      for (std::size_t i = 0; i < 3; ++i) {
        drag_N[static_cast<Eigen::Index>(i)] = SoilReference().Resistance(loads_N[side + i]);
      }
      const Eigen::Vector3d expected_N = Side(params).Loads(side_N, 0.0, drag_N, drag_N);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(loads_N[side + i], expected_N[static_cast<Eigen::Index>(i)], 0.5)
            << "slope " << slope_deg << ", wheel " << side + i;
      }
    }
  }
}

// Without friction, drag and slope the same levers in their simplest form: the rocker wheel and the
// bogie pivot share what a side carries, the bogie halves its share.
TEST(StaticLoads, LevelWithoutFriction) {
  RoverParams params{.mass = {.chassis_com_x_m = 0.02}};
  const Weights w(params);
  const RoverOn rover(SlopeTerrain(0.0, 0.0, RigidGround(0.0)), params);
  RunFor(*rover, kBraked, 3.0);
  const RoverGeometry g = MakeRoverGeometry(params.geometry);
  const double rocker_wheel_x = g.wheel_R[2].x();
  const double bogie_x = g.bogie_pivot_R[0].x();
  const double carried_N = 0.5 * w.chassis_N + w.rocker_N + w.wheel_N;
  const double moment_Nm = 0.5 * w.chassis_N * params.mass.chassis_com_x_m +
                           w.rocker_N * g.rocker_pivot_R[0].x() + w.wheel_N * rocker_wheel_x;
  const double rocker_wheel_N = (moment_Nm - carried_N * bogie_x) / (rocker_wheel_x - bogie_x);
  const double bogie_wheel_N = 0.5 * (carried_N - rocker_wheel_N + w.bogie_N) + w.wheel_N;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    EXPECT_NEAR(rover->state().wheel_load_N[i], g.on_bogie[i] ? bogie_wheel_N : rocker_wheel_N,
                0.05);
  }
}

}  // namespace
}  // namespace rockyard::rover
