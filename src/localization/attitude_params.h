/// @file
/// Parameters of the attitude that the rover believes.
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
    v.Choice("height", height,
             core::Assumed("what the height above the start comes from",
                           "odometry along the slope is what a rover without visual odometry has"));
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
