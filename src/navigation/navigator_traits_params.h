// What the rest of a trial has to know of a navigator beside its decisions.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <variant>

namespace rockyard::navigation {

// What it reads of a look at the terrain.
enum class LookReading {
  kHazardReport,  // per stripe; the rocks that it had to see are counted as met and missed
  kPoints,        // it believes in no single hazards, so that none can be met or missed
  kNothing,       // it never looks
};

// What its part of a look takes on the rover's computer.
struct CostOfJudgement {};  // clock.compute.behaviour_s, where a computer judges elevations
struct CostOfMap {          // map and votes, by the tables of Goldberg 2002, section 5
  double cell_m = 0.2;      // side of a square of the same area as a cell
  double area_m2 = 100.0;   // of the grid
};
struct CostOfLook {  // its own
  double time_s = 0.0;
};
using DecisionCost = std::variant<CostOfJudgement, CostOfMap, CostOfLook>;

// A parameter of the navigator, by its path in the navigator's group.
struct GoalTolerance {
  std::string_view path = "goal_tolerance_m";
  double tolerance_m = 0.0;  // it arrives where it believes to be no farther from its goal
};

// The names that it has for the stripes of a report.
struct StripeNames {
  std::string_view path;   // where they are named
  std::string_view names;  // "names with ...": what is wrong where their number is
  std::size_t count = 0;
};

// How large it takes the rover for.
struct BelievedSize {
  std::string_view length_path;
  double length_m = 0.0;
  std::string_view width_path;
  double width_m = 0.0;
  std::string_view suggestion;  // where it is another rover's
};

// How fast the curvature of its motions may change.
struct CurvatureRates {
  std::string_view path;       // of the limit
  double limit_per_m_s = 0.0;  // of |dc/dt|
  double least_per_m2 = 0.0;   // |dc/ds| from one of its curvatures to the next
};

struct NavigatorTraits {
  // What no navigator can leave open.
  NavigatorTraits(LookReading reading, const DecisionCost& decision, const GoalTolerance& tolerance)
      : reads(reading), cost(decision), goal(tolerance) {}

  LookReading reads;
  DecisionCost cost;
  GoalTolerance goal;
  std::optional<StripeNames> stripes;
  std::optional<BelievedSize> size;
  bool follows_route = false;  // of an oracle, planned once from the start to the goal
  bool looks_on_the_move = false;
  bool steers_on_the_move = false;
  std::optional<CurvatureRates> curvature_rates;  // where it chooses among them
};

}  // namespace rockyard::navigation
