/// @file
/// Parameters of dead reckoning.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"

namespace rockyard::localization {

/// Whose encoders give the distance.
enum class OdometryWheels {
  kAll,  ///< mean of all six; too long on arcs, where corner wheels run wider circles: 1 to 4 %
         ///< on those of Rocky 3.2, 27 % on the tightest of GESTALT with the Athena SDM
  kUnsteered,  ///< mean of the wheels that are not steered: exact on arcs
  kForward,    ///< mean over all six of what they roll times the cosine of their steering angle:
               ///< exact on arcs where all wheels are steered
};

/// The heading along which a step's distance is laid off.
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
struct rockyard::core::EnumNames<rockyard::localization::OdometryWheels> {
  static constexpr std::array<std::string_view, 3> kNames{"all", "unsteered", "forward"};
};

/// The names of its values in a scenario.
template <>
struct rockyard::core::EnumNames<rockyard::localization::StepHeading> {
  static constexpr std::array<std::string_view, 2> kNames{"midpoint", "start"};
};
