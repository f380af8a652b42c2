/// @file
/// Parameters of dead reckoning, and of the attitude that the rover believes.
///
/// They stand in the group `perception` of a scenario and are handed to every estimator. Records
/// depend on a default in every scenario that leaves its parameter out; a bound only refuses files.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"

namespace rockyard::localization {

/// Where roll and pitch come from.
enum class AttitudeSource {
  kLevel,           ///< the rover takes itself to be level
  kAccelerometers,  ///< where it has them; level where not
};

/// Where the height above the start comes from.
enum class HeightSource {
  kLevel,       ///< the ground is taken to be flat: z = 0
  kIntegrated,  ///< z grows by the distance driven times the sine of the climb
};

/// How roll, pitch and height become what the rover believes of its stance.
struct AttitudeParams {
  AttitudeSource source = AttitudeSource::kAccelerometers;
  double filter_s = 0.5;  ///< time constant of a low pass on the specific force; 0: none
  HeightSource height = HeightSource::kIntegrated;

  /// Lists every field with its meaning, bounds and source.
  void Visit(core::FieldVisitor& v) {
    v.Choice(
        "source", source,
        core::Assumed("what roll and pitch come from; level where the rover has no accelerometers",
                      "Goldberg 2002 sec. 4 asks for an attitude estimate without naming one"));
    v.Real("filter_s", filter_s,
           core::Assumed("time constant of the low pass on the specific force; 0: none",
                         "longer than a jolt, shorter than the drive over half a wheel diameter",
                         {0.0, 100.0}, {0.0, 2.0}));
    v.Choice(
        "height", height,
        core::Assumed("what the height above the start comes from",
                      "a rover without visual odometry has nothing but way and climb to add up"));
  }
};

/// Whose encoders give the distance.
enum class OdometryWheels {
  kAll,  ///< mean of all six; too long on arcs, where corner wheels run wider circles: by 1 to 4 %
         ///< on arcs of Rocky 3.2, by 27 % on the tightest arc of GESTALT with the Athena SDM
  kUnsteered,  ///< mean of the wheels that are not steered: exact on arcs
  kForward,    ///< mean over all six of what they roll times the cosine of their steering angle:
               ///< exact on arcs where all wheels are steered
};

/// The heading along which the distance of a step is driven.
enum class StepHeading {
  kMidpoint,  ///< half of the step's turn is added first
  kStart,     ///< the heading at the start of the step, as in the equations of section 5
};

/// How wheel turns become a pose.
struct DeadReckoningParams {
  double distance_scale = 1.0;  ///< distance driven over distance rolled
  OdometryWheels wheels = OdometryWheels::kAll;
  StepHeading step_heading = StepHeading::kMidpoint;

  /// Lists every field with its meaning, bounds and source.
  void Visit(core::FieldVisitor& v) {
    v.Real(
        "distance_scale", distance_scale,
        core::Calibrated(
            "distance driven over distance rolled by the wheels, calibrated for slip on level sand",
            "Matthies 1995 sec. 5, note 4; straight 7 m runs of the simulated rover on level sand",
            {0.1, 2.0}));
    v.Choice(
        "wheels", wheels,
        core::Assumed("wheels whose encoders give the distance, and whether their steering counts",
                      "the paper names wheel encoders without singling any out"));
    v.Choice("step_heading", step_heading,
             core::Assumed("heading along which a step's distance is laid off",
                           "the better of the two approximations at equal cost"));
  }
};

}  // namespace rockyard::localization

/// The names of its values in a scenario.
template <>
struct rockyard::core::EnumNames<rockyard::localization::AttitudeSource> {
  static constexpr std::array<std::string_view, 2> kNames{"level", "accelerometers"};
};

/// The names of its values in a scenario.
template <>
struct rockyard::core::EnumNames<rockyard::localization::HeightSource> {
  static constexpr std::array<std::string_view, 2> kNames{"level", "integrated"};
};

/// The names of its values in a scenario.
template <>
struct rockyard::core::EnumNames<rockyard::localization::OdometryWheels> {
  static constexpr std::array<std::string_view, 3> kNames{"all", "unsteered", "forward"};
};

/// The names of its values in a scenario.
template <>
struct rockyard::core::EnumNames<rockyard::localization::StepHeading> {
  static constexpr std::array<std::string_view, 2> kNames{"midpoint", "start"};
};
