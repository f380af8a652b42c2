#include "navigation/navigator_set_params.h"

#include <array>

namespace rockyard::navigation {
namespace {

using core::Setting;

// What else the group holds (NavigationParams of trial/drive_params.h): no navigator may take one
// of these names.
constexpr std::array<std::string_view, 3> kOtherKeys{"on_board_stuck", "on_slip", "wheel_driver"};

}  // namespace

NavigatorSet::NavigatorSet()
    : KindSet({.group = "navigation",
               .key = "navigator",
               .one = "a navigator",
               .others = kOtherKeys,
               .choice = Setting(
                   "what decides the motions; the groups of other navigators do nothing")}) {}

}  // namespace rockyard::navigation
