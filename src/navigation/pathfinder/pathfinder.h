// The Pathfinder behaviour controller (Matthies 1995, section 7), the navigator `pathfinder`, by
// which drives go unless a scenario names another: no map, no memory beyond the manoeuvre under
// way.
//
//   IF no hazard: move forward and turn toward the goal;
//   ELSE IF hazard on the left: turn in place to the right until no hazard is detected;
//   ELSE IF hazard on the right: turn in place to the left until no hazard is detected.
//   A centre hazard is passed on the right if that is clear, otherwise on the left.
//
// Scans are taken at rest: before the first move, after every scan_interval_m of measured driving,
// and after every turn_increment of measured turning. A hazard that the rover feels interrupts
// whatever is under way (vehicle_reaction.h); afterwards the rover scans and goes on. What the
// paper leaves open is in PathfinderParams. Records of its drives depend on all of it: sides of
// turns, and the ticks at which legs end.
#pragma once

#include <limits>
#include <optional>

#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"
#include "navigation/pathfinder/pathfinder_params.h"
#include "navigation/pathfinder/vehicle_reaction.h"

namespace rockyard::navigation {

// Directions of turns in place.
inline constexpr int kLeft = +1;
inline constexpr int kRight = -1;

// The sides on which a report shows hazards.
struct HazardSides {
  bool left = false;
  bool centre = false;
  bool right = false;

  bool any() const { return left || centre || right; }
};

// Returns the sides on which `report` shows hazards, by the parameters' names for its stripes.
HazardSides ClassifySides(const messages::HazardReport& report, const PathfinderParams& params);

// Returns the turn direction (+1 left, -1 right) that the rules choose. `goal_bearing_rad` is
// positive when the goal lies to the left. The report must show a hazard.
int ChooseTurn(const messages::HazardReport& report, double goal_bearing_rad,
               const PathfinderParams& params);

// Returns the curvature (1/m, positive left) that leads towards a goal at the given bearing.
double CurvatureToGoal(double goal_bearing_rad, const PathfinderParams& params);

// The controller of one drive. It draws no random numbers.
class PathfinderNavigator final : public Navigator {
 public:
  // `uses_hazard_sensor` false: the rover drives blind, it never asks for a scan.
  PathfinderNavigator(const PathfinderParams& params, const messages::Goal& goal,
                      bool uses_hazard_sensor);

  NavigatorDecision Decide(const NavigatorInput& input) override;
  void OnPoseUpdate(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override;
  // An avoidance under way goes on. Whether to turn in place towards the next goal is asked anew.
  void SetGoal(const messages::Goal& goal, GoalChange change) override;

 private:
  enum class Mode {
    kScanning,    // at rest, waiting for a report
    kForward,     // arc towards the goal
    kClearing,    // straight on after a turn
    kAvoiding,    // turning in place away from a hazard
    kFacingGoal,  // turning in place towards the goal
    kThreading,   // straight on between two hazards
    kBackingOff,
  };

  NavigatorDecision AfterReaction(const NavigatorInput& input);
  NavigatorDecision OnReport(const NavigatorInput& input);
  NavigatorDecision OnHazard(const NavigatorInput& input);
  NavigatorDecision OnClear(const NavigatorInput& input);
  NavigatorDecision Continue(const NavigatorInput& input);
  NavigatorDecision ContinueTurn(const NavigatorInput& input);
  NavigatorDecision ContinueDrive(const NavigatorInput& input);

  NavigatorDecision GoOn(const NavigatorInput& input) const;
  NavigatorDecision BeginScan();
  NavigatorDecision ScanOrGoOn(const NavigatorInput& input);
  NavigatorDecision BeginForward(const NavigatorInput& input);
  NavigatorDecision BeginStraight(Mode mode, double distance_m, const NavigatorInput& input);
  NavigatorDecision BeginTurn(Mode mode, int direction, const NavigatorInput& input);

  double GoalBearing(const messages::PoseEstimate& estimate) const;
  double GoalDistance(const messages::PoseEstimate& estimate) const;
  bool NeedsPointTurn(const messages::PoseEstimate& estimate) const;
  bool AtGoal(const messages::PoseEstimate& estimate) const;

  PathfinderParams params_;
  messages::Goal goal_;
  bool uses_hazard_sensor_;
  VehicleReaction reaction_;
  bool reacting_ = false;  // reaction_ decided at the last tick

  Mode mode_ = Mode::kScanning;
  bool started_ = false;
  bool facing_goal_ = false;  // a turn in place towards the goal is under way
  messages::MotionCommand motion_;
  messages::PoseEstimate anchor_;  // estimate when the running manoeuvre began
  double leg_m_ = 0.0;             // length of the running leg
  double clearing_left_m_ = 0.0;   // of the straight drive after a turn
  double odometer_at_scan_m_ = 0.0;
  double odometer_at_avoiding_m_ = -std::numeric_limits<double>::infinity();
  std::optional<int> avoid_direction_;  // latched while avoiding
  double avoided_turn_rad_ = 0.0;       // measured since the hazard appeared
};

// Describes the navigator `pathfinder`, for a set of navigators.
NavigatorDescription<PathfinderParams> DescribePathfinder();

}  // namespace rockyard::navigation
