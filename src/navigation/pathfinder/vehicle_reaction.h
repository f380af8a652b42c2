// The reaction of the behaviour controller to a hazard that the rover feels: stop, back off, turn
// away from its side.
//
// A hazard ahead is passed on the right, as one that is seen in the centre. A touch behind ends a
// back-off and does nothing else: the rover drives away from it by going on. During a reaction the
// hazard that started it may last. While the rover turns, the reaction starts again with a touch
// after a tick without a touch, and with a hazard of another kind after a tick without any hazard.
// Tilts, joint angles and currents of the kind that started it do not start it again: one near its
// threshold would do so with every noisy sample. What still holds when the turn has ended starts
// the next reaction. Draws no random numbers. Only Pathfinder reacts so: records of its drives that
// feel a hazard depend on it, no others.
#pragma once

#include <limits>
#include <optional>

#include "navigation/navigator.h"
#include "navigation/pathfinder/pathfinder_params.h"

namespace rockyard::navigation {

// The reaction under way, if any.
class VehicleReaction {
 public:
  explicit VehicleReaction(const VehicleReactionParams& params) : params_(params) {}

  // Returns what the reaction asks for at this tick; nothing while there is none, and at the tick
  // at which it has ended.
  std::optional<NavigatorDecision> Decide(const NavigatorInput& input, double goal_distance_m);

  void OnPoseUpdate(const messages::PoseEstimate& before, const messages::PoseEstimate& after);

  // The goal is another one from now on: progress, and reactions without it, count anew.
  void OnNextGoal();

 private:
  enum class Stage { kNone, kBackingOff, kTurning };

  std::optional<NavigatorDecision> Begin(const NavigatorInput& input, double goal_distance_m);
  std::optional<NavigatorDecision> BackOff(const NavigatorInput& input);
  std::optional<NavigatorDecision> Turn(const NavigatorInput& input, double goal_distance_m);
  // Returns whether `hazard` is new since the reaction began.
  bool Appeared(const messages::VehicleHazard& hazard) const;
  NavigatorDecision Start(Stage stage, const messages::MotionCommand& motion,
                          const messages::PoseEstimate& estimate);
  NavigatorDecision GoOn() const { return {NavigatorStatus::kDriving, {}, motion_}; }

  VehicleReactionParams params_;
  Stage stage_ = Stage::kNone;
  messages::MotionCommand motion_;
  messages::PoseEstimate anchor_;  // estimate when the stage began
  int turn_direction_ = 0;
  messages::VehicleHazardKind cause_ = messages::VehicleHazardKind::kContact;
  bool was_clear_ = false;     // nothing felt at some tick of this reaction
  bool was_released_ = false;  // no touch at some tick of this reaction
  std::int64_t repeats_ = 0;
  double best_goal_distance_m_ = std::numeric_limits<double>::infinity();
  double ignored_until_m_ = -std::numeric_limits<double>::infinity();  // odometer
};

}  // namespace rockyard::navigation
