// Messages of an estimator in which every member has a value of its own, and all members of a
// message as one list of numbers. Tests and the plugin `estimators` list members alike, so that a
// member that is lost or swapped on the way from one to the other shows. A member that is added
// does not compile here before it is listed, too.
#pragma once

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <vector>

#include "localization/estimator.h"
#include "localization/estimator_set_params.h"
#include "messages/aids.h"
#include "messages/measurements.h"
#include "messages/vehicle_state.h"

namespace rockyard::plugin {

using Numbers = std::vector<double>;

// What the plugin shows of the last message: as many numbers as any message has; NaN: none.
inline constexpr std::size_t kShownNumbers = 90;

class NumberList {
 public:
  template <typename... Values>
  void Add(Values... values) {
    (numbers_.push_back(static_cast<double>(values)), ...);
  }
  template <typename List>
  void AddList(const List& list) {
    for (const auto value : list) Add(value);
  }
  // One number a row, in which each entry has a weight of its own.
  template <typename Matrix>
  void AddRows(const Matrix& matrix) {
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
      double sum = 0.0;
      for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
        sum += static_cast<double>(column + 1) * matrix(row, column);
      }
      Add(sum);
    }
  }
  Numbers Take() {
    numbers_.resize(kShownNumbers, std::numeric_limits<double>::quiet_NaN());
    return numbers_;
  }

 private:
  Numbers numbers_;
};

inline void AddMemory(const localization::EstimatorMemory& from, NumberList& list) {
  const auto& [pose, covariance, gyro_scale, wheel_scale, pan_rad] = from;
  const auto& [x_m, y_m, heading_rad] = pose;
  list.Add(x_m, y_m, heading_rad, gyro_scale, wheel_scale, pan_rad, covariance.has_value());
  if (covariance) list.AddRows(*covariance);
}

// The limits are none of a plugin's.
inline Numbers NumbersOf(const localization::EstimatorSetup& setup) {
  const auto& [calibration, dead_reckoning, attitude, start, lander, memory, call_cpu_s,
               drive_cpu_s] = setup;
  NumberList list;
  const auto& [wheel_radius_m, radius_ratio, wheel_x_m, wheel_y_m, steered, steering_offset_rad,
               max_steer_rad, max_wheel_speed_m_s] = calibration;
  list.Add(wheel_radius_m, steering_offset_rad, max_steer_rad, max_wheel_speed_m_s);
  for (const auto& each : {radius_ratio, wheel_x_m, wheel_y_m}) list.AddList(each);
  list.AddList(steered);
  const auto& [distance_scale, wheels, step_heading] = dead_reckoning;
  const auto& [source, filter_s, height] = attitude;
  list.Add(distance_scale, wheels, step_heading, source, filter_s, height);
  const auto& [x_m, y_m, heading_rad] = start;
  list.Add(x_m, y_m, heading_rad, lander.has_value(), memory != nullptr);
  if (lander) {
    const auto& [lander_x_m, lander_y_m, pan_sd_rad] = *lander;
    list.Add(lander_x_m, lander_y_m, pan_sd_rad);
  }
  if (memory != nullptr) AddMemory(*memory, list);
  return list.Take();
}

inline Numbers NumbersOf(const messages::MotionMeasurement& motion) {
  const auto& [duration_s, wheel_turn_rad, steer_rad, turn_rad] = motion;
  NumberList list;
  list.Add(duration_s, turn_rad);
  list.AddList(wheel_turn_rad);
  list.AddList(steer_rad);
  return list.Take();
}

inline Numbers NumbersOf(const messages::VehicleState& felt, double duration_s) {
  const auto& [articulation, specific_force_R, motor_current_A, contact] = felt;
  NumberList list;
  list.Add(duration_s, articulation.has_value(), specific_force_R.has_value(),
           motor_current_A.has_value(), contact.has_value());
  if (articulation) {
    const auto& [left_rocker, right_rocker, left_bogie, right_bogie] = *articulation;
    list.Add(left_rocker, right_rocker, left_bogie, right_bogie);
  }
  if (specific_force_R) list.AddList(*specific_force_R);
  if (motor_current_A) list.AddList(*motor_current_A);
  if (contact) list.AddList(*contact);
  return list.Take();
}

inline Numbers NumbersOf(const messages::PoseUpdate& update) {
  const auto& [x_m, y_m, heading_rad, mirrored] = update;
  NumberList list;
  list.Add(x_m, y_m, heading_rad, mirrored);
  return list.Take();
}

inline Numbers NumbersOf(const messages::PoseFix& fix) {
  const auto& [capture, measured, pose, covariance, in_lander_frame] = fix;
  NumberList list;
  list.Add(capture, measured.to_ulong(), in_lander_frame);
  list.AddList(pose);
  list.AddList(covariance.reshaped());
  return list.Take();
}

inline Numbers NumbersOf(const messages::RelativeMotion& motion) {
  const auto& [from, to, motion_F, covariance] = motion;
  NumberList list;
  list.Add(from, to);
  list.AddList(motion_F);
  list.AddList(covariance.reshaped());
  return list.Take();
}

// A number to tell a capture or forgetting by.
inline Numbers NumbersOf(double kind, messages::CaptureNumber capture) {
  NumberList list;
  list.Add(kind, capture);
  return list.Take();
}

// A symmetric matrix of numbers that start at `first`.
template <typename Matrix>
Matrix Symmetric(double first) {
  Matrix matrix;
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = row; column < matrix.cols(); ++column) {
      matrix(row, column) = matrix(column, row) = first++;
    }
  }
  return matrix;
}

inline localization::EstimatorMemory WholeMemory() {
  return {.pose = {1.5, 2.5, 0.25},
          .covariance = Symmetric<localization::ErrorMatrix>(200.5),
          .gyro_scale = 1.125,
          .wheel_scale = 0.875,
          .pan_rad = 0.0625};
}

// `memory` may be null.
inline localization::EstimatorSetup WholeSetup(const localization::EstimatorMemory* memory) {
  localization::EstimatorSetup setup;
  setup.calibration = {.wheel_radius_m = 0.109375,
                       .radius_ratio = {71.5, 72.5, 73.5, 74.5, 75.5, 76.5},
                       .wheel_x_m = {51.5, 52.5, 53.5, 54.5, 55.5, 56.5},
                       .wheel_y_m = {61.5, 62.5, 63.5, 64.5, 65.5, 66.5},
                       .steered = {true, false, true, true, false, false},
                       .steering_offset_rad = -0.03125,
                       .max_steer_rad = 0.84375,
                       .max_wheel_speed_m_s = 0.140625};
  setup.dead_reckoning = {0.96875, localization::OdometryWheels::kForward,
                          localization::StepHeading::kStart};
  setup.attitude = {localization::AttitudeSource::kAccelerometers, 0.71875,
                    localization::HeightSource::kLevel};
  setup.start = {3.5, 4.5, 0.375};
  setup.lander = {.x_m = 5.5, .y_m = 6.5, .pan_sd_rad = 0.046875};
  setup.memory = memory;
  return setup;
}

inline messages::MotionMeasurement WholeMotion() {
  return {.duration_s = 0.046875,
          .wheel_turn_rad = {1.5, 2.5, 3.5, 4.5, 5.5, 6.5},
          .steer_rad = {11.5, 12.5, 13.5, 14.5, 15.5, 16.5},
          .turn_rad = 0.21875};
}

inline messages::VehicleState WholeFelt() {
  return {.articulation = messages::Articulation{22.5, 23.5, 24.5, 25.5},
          .specific_force_R = math::Vector3(26.5, 27.5, 28.5),
          .motor_current_A = messages::PerWheel<double>{29.5, 30.5, 31.5, 32.5, 33.5, 34.5},
          .contact = messages::ContactSwitches{true, false, true, false, false, true, true}};
}

inline messages::PoseFix WholeFix() {
  messages::PoseFix fix;
  fix.capture = 9007199254740993;
  fix.measured = 0b100110;
  fix.pose << 1.5, 2.5, 3.5, 4.5, 5.5, 6.5;
  fix.covariance = Symmetric<messages::PoseCovariance>(100.5);
  fix.in_lander_frame = true;
  return fix;
}

inline messages::RelativeMotion WholeRelativeMotion() {
  messages::RelativeMotion motion;
  motion.from = 7;
  motion.to = 11;
  motion.motion_F << 11.5, 12.5, 13.5, 14.5, 15.5, 16.5;
  motion.covariance = Symmetric<messages::PoseCovariance>(300.5);
  return motion;
}

inline messages::LocalizationEstimate WholeEstimate() {
  return {.pose = {1.5, 2.5, 0.25, 3.5},
          .attitude = {0.125, -0.125, 0.0625},
          .odometry = {4.5, 5.5, 0.75, 6.5},
          .covariance = Symmetric<messages::PoseCovariance>(400.5),
          .world = messages::WorldEstimate{{7.5, 8.5, 1.25, 9.5},
                                           Symmetric<messages::PoseCovariance>(500.5)}};
}

inline bool Same(const messages::PoseEstimate& a, const messages::PoseEstimate& b) {
  return a.x_m == b.x_m && a.y_m == b.y_m && a.heading_rad == b.heading_rad &&
         a.distance_m == b.distance_m;
}
inline bool Same(const messages::LocalizationEstimate& a, const messages::LocalizationEstimate& b) {
  return Same(a.pose, b.pose) && a.attitude.roll_rad == b.attitude.roll_rad &&
         a.attitude.pitch_rad == b.attitude.pitch_rad && a.attitude.z_m == b.attitude.z_m &&
         Same(a.odometry, b.odometry) && a.covariance == b.covariance &&
         a.world.has_value() == b.world.has_value() &&
         (!a.world ||
          (Same(a.world->pose, b.world->pose) && a.world->covariance == b.world->covariance));
}

}  // namespace rockyard::plugin
