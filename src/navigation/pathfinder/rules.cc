#include "navigation/pathfinder/rules.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace rockyard::navigation {
namespace {

using messages::HazardReport;

int CountHazards(const HazardReport& report, const std::vector<std::int64_t>& stripes) {
  return static_cast<int>(std::count_if(stripes.begin(), stripes.end(), [&](std::int64_t stripe) {
    return report.stripe_hazard[static_cast<std::size_t>(stripe)];
  }));
}

// Stripes run from left to right: the last one is the outermost on the right.
bool RightIsClearFor(const HazardReport& report, const PathfinderParams& params) {
  if (params.right_is_clear == RightIsClear::kNoRightHazard) {
    return CountHazards(report, params.right_stripes) == 0;
  }
  return !report.stripe_hazard.back();
}

// Hazards on both sides: the printed order of the rules turns right, the other choices are
// assumptions.
int TurnFromBothSides(const HazardReport& report, double goal_bearing_rad,
                      const PathfinderParams& params) {
  switch (params.both_sides) {
    case BothSidesReaction::kRuleOrder:
      return kRight;
    case BothSidesReaction::kTowardGoal:
      return goal_bearing_rad > 0.0 ? kLeft : kRight;
    case BothSidesReaction::kFewerHazards:
      return CountHazards(report, params.left_stripes) < CountHazards(report, params.right_stripes)
                 ? kLeft
                 : kRight;
  }
  return kRight;
}

}  // namespace

HazardSides ClassifySides(const HazardReport& report, const PathfinderParams& params) {
  return {CountHazards(report, params.left_stripes) > 0,
          CountHazards(report, params.centre_stripes) > 0,
          CountHazards(report, params.right_stripes) > 0};
}

// The rules in the order in which Matthies 1995, section 7, prints them.
int ChooseTurn(const HazardReport& report, double goal_bearing_rad,
               const PathfinderParams& params) {
  const HazardSides sides = ClassifySides(report, params);
  EXPECT(sides.any());
  if (sides.left && sides.right) return TurnFromBothSides(report, goal_bearing_rad, params);
  // "IF hazard on the left: turn in place to the right".
  if (sides.left) return kRight;
  if (sides.centre) return RightIsClearFor(report, params) ? kRight : kLeft;
  return kLeft;
}

double CurvatureToGoal(double goal_bearing_rad, const PathfinderParams& params) {
  const double size = std::abs(goal_bearing_rad);
  if (size <= params.heading_deadband_rad) return 0.0;
  const double radius =
      size > params.tight_arc_bearing_rad ? params.tight_arc_radius_m : params.wide_arc_radius_m;
  // Positive to the left, as the bearing.
  return std::copysign(1.0 / radius, goal_bearing_rad);
}

}  // namespace rockyard::navigation
