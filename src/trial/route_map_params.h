// By whose knowledge of the rocks a route is planned, and who drives along it.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"

namespace rockyard::trial {

enum class RouteMap {
  kOracle,  // the true rocks
  kLander,  // those that the lander's stereo pair shows (lander_map.h)
};

enum class RouteUse {
  kNavigator,  // the navigator that follows it, blind to hazards
  kWaypoints,  // any other: its corners are places to drive to before the goal
};

struct RouteMapParams {
  RouteMap source = RouteMap::kOracle;
  RouteUse use = RouteUse::kNavigator;
  double spacing_m = 0.5;
  double passing_m = 0.3;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::trial

template <>
struct rockyard::core::EnumNames<rockyard::trial::RouteMap> {
  static constexpr std::array<std::string_view, 2> kNames{"oracle", "lander"};
};

template <>
struct rockyard::core::EnumNames<rockyard::trial::RouteUse> {
  static constexpr std::array<std::string_view, 2> kNames{"navigator", "waypoints"};
};
