#include "navigation/navigator_set_params.h"

#include <array>

namespace rockyard::navigation {
namespace {

using core::Setting;

// What else the group holds (NavigationParams of trial/drive_params.h): no navigator may take one
// of these names.
constexpr std::array<std::string_view, 4> kOtherKeys{"on_board_stuck", "on_slip", "wheel_driver",
                                                     "limits"};

}  // namespace

void LimitParams::Visit(core::FieldVisitor& v) {
  v.Real("decision_cpu_s", decision_cpu_s,
         Setting("most CPU time of one answer of a plugin or process", {1e-3, 1e6}));
  v.Real("drive_cpu_s", drive_cpu_s,
         Setting("most CPU time of all its answers of a drive", {1e-3, 1e7}));
  v.Real("memory_mb", memory_mb,
         Setting("most memory of a navigator's process, in 2^20 bytes; a plugin shares that of the "
                 "program",
                 {1.0, 1e7}));
  v.Real("answer_s", answer_s,
         Setting("longest time of the clock on the wall in which a process uses no CPU time and "
                 "gives no answer",
                 {1e-3, 1e6}));
}

NavigatorSet::NavigatorSet()
    : KindSet({.group = "navigation",
               .key = "navigator",
               .one = "a navigator",
               .others = kOtherKeys,
               .choice = Setting(
                   "what decides the motions; the groups of other navigators do nothing")}) {}

}  // namespace rockyard::navigation
