/// @file
/// Makes a plugin of estimators, header only, as navigator_plugin.h makes one of navigators:
///
///   localization::EstimatorDescription<MineParams> DescribeMine();  // as for a built-in estimator
///   ROCKYARD_PLUGIN(DescribeMine)
///
/// Class, parameters and description are the same as those of an estimator that a program links. A
/// library that includes both headers may name navigators and estimators. What an estimator throws
/// ends its drive as a fault of the navigator.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>

#include "core/fields.h"
#include "localization/error_state.h"
#include "localization/estimator.h"
#include "localization/estimator_set_params.h"
#include "messages/aids.h"
#include "messages/estimates.h"
#include "messages/measurements.h"
#include "plugin/abi.h"
#include "plugin/plugin_fields.h"

namespace rockyard::plugin {

/// What follows is for the macro alone.
namespace layer {

/// Return what the command hands over as messages.
inline messages::MotionMeasurement Motion(const rockyard_motion& from) {
  messages::MotionMeasurement to;
  to.duration_s = from.duration_s;
  std::copy_n(from.wheel_turn_rad, messages::kWheelCount, to.wheel_turn_rad.begin());
  std::copy_n(from.steer_rad, messages::kWheelCount, to.steer_rad.begin());
  to.turn_rad = from.turn_rad;
  return to;
}
inline messages::PoseFix Fix(const rockyard_fix& from) {
  messages::PoseFix to;
  to.capture = from.capture;
  for (std::size_t i = 0; i < messages::kPoseCoordinates; ++i)
    to.measured[i] = from.measured[i] != 0;
  to.pose = Eigen::Map<const messages::PoseVector>(from.pose);
  to.covariance = Eigen::Map<const messages::PoseCovariance>(from.covariance);
  to.in_lander_frame = from.in_lander_frame != 0;
  return to;
}
inline messages::RelativeMotion Relative(const rockyard_relative_motion& from) {
  messages::RelativeMotion to;
  to.from = from.from;
  to.to = from.to;
  to.motion_F = Eigen::Map<const messages::PoseVector>(from.motion_F);
  to.covariance = Eigen::Map<const messages::PoseCovariance>(from.covariance);
  return to;
}
inline localization::EstimatorMemory Memory(const rockyard_memory& from) {
  localization::EstimatorMemory to;
  to.pose = {from.x_m, from.y_m, from.heading_rad};
  to.gyro_scale = from.gyro_scale;
  to.wheel_scale = from.wheel_scale;
  to.pan_rad = from.pan_rad;
  if (from.has_covariance != 0) {
    to.covariance = Eigen::Map<const localization::ErrorMatrix>(from.covariance);
  }
  return to;
}

/// Returns all that an estimator gets at the start, but for its memory.
inline localization::EstimatorSetup Setup(const rockyard_estimator_setup& from) {
  localization::EstimatorSetup to;
  to.calibration = Wheels(from);
  to.dead_reckoning = {from.distance_scale, static_cast<localization::OdometryWheels>(from.wheels),
                       static_cast<localization::StepHeading>(from.step_heading)};
  to.attitude = {static_cast<localization::AttitudeSource>(from.attitude_source),
                 from.attitude_filter_s, static_cast<localization::HeightSource>(from.height)};
  to.start = {from.start_x_m, from.start_y_m, from.start_heading_rad};
  if (from.lander != nullptr) {
    to.lander = {from.lander->x_m, from.lander->y_m, from.lander->pan_sd_rad};
  }
  return to;
}

/// Write what an estimator says.
inline void Write(const messages::PoseEstimate& from, rockyard_pose& to) {
  to = {from.x_m, from.y_m, from.heading_rad, from.distance_m};
}
inline void Write(const messages::LocalizationEstimate& from, rockyard_estimate& to) {
  Write(from.pose, to.pose);
  to.attitude = {from.attitude.roll_rad, from.attitude.pitch_rad, from.attitude.z_m};
  Write(from.odometry, to.odometry);
  to.has_covariance = from.covariance ? 1 : 0;
  to.has_world = from.world ? 1 : 0;
  if (from.covariance) Eigen::Map<messages::PoseCovariance>(to.covariance) = *from.covariance;
  if (from.world) {
    Write(from.world->pose, to.world);
    Eigen::Map<messages::PoseCovariance>(to.world_covariance) = from.world->covariance;
  }
}
inline void Write(const localization::EstimatorMemory& from, rockyard_memory& to) {
  to.x_m = from.pose.x_m;
  to.y_m = from.pose.y_m;
  to.heading_rad = from.pose.heading_rad;
  to.gyro_scale = from.gyro_scale;
  to.wheel_scale = from.wheel_scale;
  to.pan_rad = from.pan_rad;
  to.has_covariance = from.covariance ? 1 : 0;
  if (from.covariance) Eigen::Map<localization::ErrorMatrix>(to.covariance) = *from.covariance;
}

/// An estimator, with the memory that it began with.
struct HeldEstimator {
  localization::EstimatorMemory memory;
  std::unique_ptr<localization::Estimator> estimator;
};

/// The functions of one kind of estimator.
template <auto Describe, typename Params>
struct EstimatorType {
  static int DescribeIt(rockyard_take_text take, void* to, rockyard_error* error) noexcept {
    return Guarded(error, [&] {
      const auto description = Describe();
      JsonLine json;
      WriteDescription<Params>(description, json);
      json.Key("takes_fixes").Raw(description.takes_fixes ? "true" : "false");
      json.Key("takes_motions").Raw(description.takes_motions ? "true" : "false").Raw("}");
      take(to, json.text().data(), json.text().size());
    });
  }

  static int Create(const rockyard_values* values, const rockyard_estimator_setup* setup,
                    void** estimator, rockyard_error* error) noexcept {
    return Guarded(error, [&] {
      auto held = std::make_unique<HeldEstimator>();
      localization::EstimatorSetup to = Setup(*setup);
      if (setup->memory != nullptr) {
        held->memory = Memory(*setup->memory);
        to.memory = &held->memory;
      }
      held->estimator = Describe().make(WithValues<Params>(*values), to);
      if (held->estimator == nullptr) throw std::runtime_error("it made no estimator");
      *estimator = held.release();
    });
  }

  static localization::Estimator& At(void* estimator) {
    return *static_cast<HeldEstimator*>(estimator)->estimator;
  }

  static int Propagate(void* estimator, const rockyard_motion* motion,
                       rockyard_error* error) noexcept {
    return Guarded(error, [&] { At(estimator).Propagate(Motion(*motion)); });
  }
  static int Feel(void* estimator, const rockyard_felt* felt, double duration_s,
                  rockyard_error* error) noexcept {
    return Guarded(error, [&] { At(estimator).Feel(Felt(*felt), duration_s); });
  }
  static int Place(void* estimator, const rockyard_update* update, rockyard_error* error) noexcept {
    return Guarded(error, [&] {
      At(estimator).Place({update->x_m, update->y_m, update->heading_rad, update->mirrored != 0});
    });
  }
  static int Capture(void* estimator, std::int64_t capture, rockyard_error* error) noexcept {
    return Guarded(error, [&] { At(estimator).Capture(capture); });
  }
  static int Forget(void* estimator, std::int64_t capture, rockyard_error* error) noexcept {
    return Guarded(error, [&] { At(estimator).Forget(capture); });
  }
  static int TakeFix(void* estimator, const rockyard_fix* fix, std::int32_t* use,
                     rockyard_error* error) noexcept {
    return Guarded(error,
                   [&] { *use = static_cast<std::int32_t>(At(estimator).Update(Fix(*fix))); });
  }
  static int TakeMotion(void* estimator, const rockyard_relative_motion* motion, std::int32_t* use,
                        rockyard_error* error) noexcept {
    return Guarded(
        error, [&] { *use = static_cast<std::int32_t>(At(estimator).Update(Relative(*motion))); });
  }
  static int Estimate(void* estimator, rockyard_estimate* estimate,
                      rockyard_error* error) noexcept {
    return Guarded(error, [&] { Write(At(estimator).estimate(), *estimate); });
  }
  static int Remember(void* estimator, rockyard_memory* memory, rockyard_error* error) noexcept {
    return Guarded(error, [&] { Write(At(estimator).Remember(), *memory); });
  }
  static int OwnValues(void* estimator, double* values, std::size_t count,
                       rockyard_error* error) noexcept {
    return Guarded(error, [&] { CopyOwnValues(At(estimator).own_values(), values, count); });
  }
  static void Destroy(void* estimator) noexcept { delete static_cast<HeldEstimator*>(estimator); }

  static constexpr rockyard_estimator_type kType{
      DescribeIt, Check<Params>, Create,     Propagate, Feel,     Place,     Capture,
      Forget,     TakeFix,       TakeMotion, Estimate,  Remember, OwnValues, Destroy};
};

/// What ROCKYARD_PLUGIN takes of an estimator.
template <auto Describe, typename Params>
struct TypeOf<Describe, localization::EstimatorDescription<Params>>
    : EstimatorType<Describe, Params> {};

}  // namespace layer
}  // namespace rockyard::plugin
