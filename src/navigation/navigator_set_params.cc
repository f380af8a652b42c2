#include "navigation/navigator_set_params.h"

#include <array>

namespace rockyard::navigation {
namespace {

constexpr std::array<std::string_view, 3> kOtherKeys{"on_board_stuck", "on_slip", "wheel_driver"};

}  // namespace

NavigatorSet::NavigatorSet()
    : KindSet({.group = "navigation",
               .key = "navigator",
               .one = "a navigator",
               .others = kOtherKeys,
               .choice = {.doc = "what decides the motions; the groups of other navigators do "
                                 "nothing",
                          .origin = core::Origin::kSetting}}) {}

}  // namespace rockyard::navigation
