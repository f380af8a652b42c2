// What the rover carries: its sensors, what it makes of them, and its navigator.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"
#include "navigation/pathfinder_params.h"
#include "navigation/wheel_driver_params.h"
#if __has_include("perception/dead_reckoning_params.h")
#include "perception/dead_reckoning_params.h"
#endif
#if __has_include("perception/hazard_params.h")
#include "perception/hazard_params.h"
#endif
#if __has_include("sensing/encoder_params.h")
#include "sensing/encoder_params.h"
#endif
#if __has_include("sensing/gyro_params.h")
#include "sensing/gyro_params.h"
#endif
#if __has_include("sensing/light_stripe_params.h")
#include "sensing/light_stripe_params.h"
#endif
#if __has_include("sensing/tracker_params.h")
#include "sensing/tracker_params.h"
#endif

namespace rockyard::scenario {

// Where the pose that the rover believes comes from.
enum class Localization {
  kDeadReckoning,  // wheel encoders and gyro
  kOracle,         // the true pose: a sensor without noise, marked in the results
};

enum class NavigatorKind {
  kPathfinder,  // behaviour controller of Matthies 1995, section 7
};

struct SensorParams {
  Localization localization = Localization::kDeadReckoning;
#if __has_include("sensing/light_stripe_params.h")
  sensing::LightStripeParams light_stripe;
#endif
#if __has_include("sensing/gyro_params.h")
  sensing::GyroParams gyro;
#endif
#if __has_include("sensing/encoder_params.h")
  sensing::EncoderParams encoders;
#endif
#if __has_include("sensing/tracker_params.h")
  sensing::TrackerParams tracker;
#endif

  void Visit(core::FieldVisitor& v);
};

struct PerceptionParams {
#if __has_include("perception/hazard_params.h")
  perception::HazardParams hazard;
#endif
#if __has_include("perception/dead_reckoning_params.h")
  perception::DeadReckoningParams dead_reckoning;
#endif

  void Visit(core::FieldVisitor& v);
};

struct NavigationParams {
  NavigatorKind navigator = NavigatorKind::kPathfinder;
  navigation::PathfinderParams pathfinder;
  navigation::WheelDriverParams wheel_driver;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::scenario

template <>
struct rockyard::core::EnumNames<rockyard::scenario::Localization> {
  static constexpr std::array<std::string_view, 2> kNames{"dead_reckoning", "oracle"};
};

template <>
struct rockyard::core::EnumNames<rockyard::scenario::NavigatorKind> {
  static constexpr std::array<std::string_view, 1> kNames{"pathfinder"};
};
