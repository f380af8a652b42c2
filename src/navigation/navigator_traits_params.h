/// @file
/// What the rest of a trial has to know of a navigator beside its decisions. Conditions on
/// scenarios (trial/drive_checks_params.h), the time that a decision takes (trial/clock) and the
/// use of a look (trial/sight) depend on these traits and on no navigator's name, so that a
/// navigator that a program adds works in the same way; only messages name navigators that would
/// help.
///
/// Must stay: values that own navigators state. `reads` and `cost` change records; most of the rest
/// decides which scenarios are refused (drive_checks_params.cc, drive_consistency_params.cc of
/// trial). No fingerprint holds a trait. Programs state traits, too: a new one is optional.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <variant>

namespace rockyard::navigation {

/// What the navigator reads of a look at the terrain.
enum class LookReading {
  kHazardReport,  ///< per stripe; the rocks that it had to see are counted as met and missed
  kPoints,        ///< it believes in no single hazards, so that none can be met or missed
  kNothing,       ///< it never looks, or reads images alone (NavigatorTraits::images)
};

/// The navigator's part of a look takes clock.compute.behaviour_s on the rover's computer, where a
/// computer judges elevations.
struct CostOfJudgement {};
/// It takes what map and votes take by the tables of Goldberg 2002, section 5.
struct CostOfMap {
  double cell_m = 0.2;     ///< side of a square of the same area as a cell
  double area_m2 = 100.0;  ///< of the grid
};
/// It takes a time of its own.
struct CostOfLook {
  double time_s = 0.0;  ///< of each look, >= 0
};
/// What the navigator's part of a look costs.
using DecisionCost = std::variant<CostOfJudgement, CostOfMap, CostOfLook>;

/// How near the navigator has to believe itself to its goal. Paths, here and below, are those of
/// its parameters in its group.
struct GoalTolerance {
  std::string_view path = "goal_tolerance_m";
  double tolerance_m = 0.0;  ///< believed distance up to which it says that it has arrived
};

/// The names that the navigator has for the stripes of a report.
struct StripeNames {
  std::string_view path;   ///< of a parameter that names some
  std::string_view names;  ///< "names with ...": begins the message on a wrong number
  std::size_t count = 0;   ///< of names: as many as the sensor's array has stripes
};

/// How large the navigator takes the rover for.
struct BelievedSize {
  std::string_view length_path;  ///< of the parameter that says so
  double length_m = 0.0;         ///< along x of R
  std::string_view width_path;   ///< of the parameter that says so
  double width_m = 0.0;          ///< along y of R
  std::string_view suggestion;   ///< what to do where the size is another rover's
};

/// How fast the curvature of the navigator's motions may change.
struct CurvatureRates {
  std::string_view path;       ///< of the limit
  double limit_per_m_s = 0.0;  ///< of |dc/dt|
  double least_per_m2 = 0.0;   ///< |dc/ds| between neighbouring curvatures among which it chooses
};

/// All that the rest of a trial knows of a navigator.
struct NavigatorTraits {
  /// Takes the traits that no navigator can leave open.
  NavigatorTraits(LookReading reading, const DecisionCost& decision, const GoalTolerance& tolerance)
      : reads(reading), cost(decision), goal(tolerance) {}

  LookReading reads;
  DecisionCost cost;
  GoalTolerance goal;
  std::optional<StripeNames> stripes;  ///< where it names stripes
  std::optional<BelievedSize> size;    ///< where it has parameters of size
  bool follows_route = false;          ///< the drive plans it once, from the start to the goal
  bool looks_on_the_move = false;      ///< asks for looks while it drives
  bool steers_on_the_move = false;     ///< drives clothoids
  std::optional<CurvatureRates> curvature_rates;  ///< where it chooses among clothoids
  /// Gets the images of each look beside what it reads. With LookReading::kNothing they are all
  /// that comes of a look: nobody matches them, and the look takes no time for that.
  bool images = false;
};

}  // namespace rockyard::navigation
