// What the rover carries: its sensors, what it makes of them, and its navigator.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"
#include "navigation/pathfinder_params.h"
#include "navigation/wheel_driver_params.h"
#include "perception/calibration_params.h"
#include "perception/dead_reckoning_params.h"
#include "perception/hazard_params.h"
#include "perception/stripe_finder_params.h"
#include "perception/vehicle_hazard_params.h"
#include "sensing/encoder_params.h"
#include "sensing/gyro_params.h"
#include "sensing/light_stripe_params.h"
#include "sensing/sun_params.h"
#include "sensing/tracker_params.h"
#include "sensing/vehicle_sensor_params.h"

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
  sensing::LightStripeParams light_stripe;
  sensing::SunParams sun;
  sensing::GyroParams gyro;
  sensing::EncoderParams encoders;
  sensing::TrackerParams tracker;
  sensing::VehicleSensorParams vehicle;

  void Visit(core::FieldVisitor& v);
};

struct PerceptionParams {
  perception::StripeFinderParams stripe_finder;
  perception::HazardParams hazard;
  perception::VehicleHazardParams vehicle_hazard;
  perception::DeadReckoningParams dead_reckoning;
  perception::CalibrationErrorParams calibration;

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
