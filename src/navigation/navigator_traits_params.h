/// @file
/// What the rest of a trial has to know of a navigator beside its decisions. A drive goes by these
/// and by no navigator's name: its conditions, the time that a decision takes, what is made of a
/// look. One that a program adds works in the same way.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <variant>

namespace rockyard::navigation {

/// What it reads of a look at the terrain.
enum class LookReading {
  kHazardReport,  ///< per stripe; the rocks that it had to see are counted as met and missed
  kPoints,        ///< it believes in no single hazards, so that none can be met or missed
  kNothing,       ///< it never looks
};

/// What its part of a look takes on the rover's computer: clock.compute.behaviour_s, where a
/// computer judges elevations.
struct CostOfJudgement {};
/// Map and votes, by the tables of Goldberg 2002, section 5.
struct CostOfMap {
  double cell_m = 0.2;     ///< side of a square of the same area as a cell
  double area_m2 = 100.0;  ///< of the grid
};
/// A time of its own.
struct CostOfLook {
  double time_s = 0.0;  ///< of each look, >= 0
};
/// One of the three.
using DecisionCost = std::variant<CostOfJudgement, CostOfMap, CostOfLook>;

/// A parameter of the navigator, by its path in the navigator's group.
struct GoalTolerance {
  std::string_view path = "goal_tolerance_m";
  double tolerance_m = 0.0;  ///< it arrives where it believes to be no farther from its goal
};

/// The names that it has for the stripes of a report.
struct StripeNames {
  std::string_view path;   ///< where they are named
  std::string_view names;  ///< "names with ...": what is wrong where their number is
  std::size_t count = 0;   ///< of names
};

/// How large it takes the rover for.
struct BelievedSize {
  std::string_view length_path;  ///< of the parameter that says so
  double length_m = 0.0;         ///< along x of R
  std::string_view width_path;   ///< of the parameter that says so
  double width_m = 0.0;          ///< along y of R
  std::string_view suggestion;   ///< where it is another rover's
};

/// How fast the curvature of its motions may change.
struct CurvatureRates {
  std::string_view path;       ///< of the limit
  double limit_per_m_s = 0.0;  ///< of |dc/dt|
  double least_per_m2 = 0.0;   ///< |dc/ds| from one of its curvatures to the next
};

/// All that the rest of a trial knows of a navigator.
struct NavigatorTraits {
  /// What no navigator can leave open.
  NavigatorTraits(LookReading reading, const DecisionCost& decision, const GoalTolerance& tolerance)
      : reads(reading), cost(decision), goal(tolerance) {}

  LookReading reads;
  DecisionCost cost;
  GoalTolerance goal;
  std::optional<StripeNames> stripes;  ///< where it names them
  std::optional<BelievedSize> size;    ///< where it has such parameters
  bool follows_route = false;          ///< of an oracle, planned once from the start to the goal
  bool looks_on_the_move = false;      ///< asks for looks while it drives
  bool steers_on_the_move = false;     ///< drives clothoids
  std::optional<CurvatureRates> curvature_rates;  ///< where it chooses among them
};

}  // namespace rockyard::navigation
