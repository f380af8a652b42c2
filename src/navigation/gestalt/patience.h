// How long GESTALT goes on: progress towards its goal, and the search for a way. The cycle gives up
// by both. Records depend on both: they decide when a drive has given up, and when felt places are
// forgotten.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "navigation/gestalt/gestalt_params.h"
#include "navigation/gestalt/votes.h"

namespace rockyard::navigation {

// Progress towards the goal. Invariant: cycles and felt hazards are counted from the last gain,
// which is a distance to the goal that is progress_m less than the best one before it.
class Progress {
 public:
  explicit Progress(const GestaltDriveParams& params) : params_(params) {}

  enum class Cycle {
    kGains,
    kGoesOn,
    kGivesUp,  // max_fruitless_cycles are over
  };

  // Counts a cycle that begins at that distance from the goal. Progress counts from the first
  // distance to a goal, which is no gain itself.
  Cycle BeginCycle(double goal_distance_m);

  // Counts what the rover has turned on the move since the last call, |change of heading|.
  void CountTurn(double heading_rad);
  // Returns the turning that was counted since the last gain or rest.
  double turned_rad() const { return turned_rad_; }
  // Is told that the rover is at rest: what it turns counts anew.
  void Rest();

  // Counts a felt hazard. Returns false after max_felt.
  bool GoesOnAfterFelt() { return ++felt_hazards_ <= params_.max_felt; }

  // Is told that there is a next goal: all counts anew.
  void Restart();

  // Are told that the estimate or the goal has jumped: the best distance is now that one, or
  // changes by that much.
  void CountFrom(double goal_distance_m) { best_m_ = goal_distance_m; }
  void Shift(double change_m) { best_m_ += change_m; }

 private:
  GestaltDriveParams params_;
  double best_m_ = std::numeric_limits<double>::infinity();
  std::int64_t fruitless_cycles_ = 0;
  std::int64_t felt_hazards_ = 0;
  double turned_rad_ = 0.0;
  std::optional<double> heading_rad_;  // at the last count
};

// Turning in place for want of a way. Invariant: a search turns to one side only, as what it has
// just seen lies on the other, and no farther than search_turn since the last drive.
class Search {
 public:
  explicit Search(const GestaltParams& params);

  // Returns the turn in place that competes with arcs: the next turn of a search, or, without a
  // search, the best of all.
  messages::MotionVote& NextTurn(MotionVotes& votes, double goal_bearing_rad) const;

  bool HasTurnedAround() const;

  // A search goes on to that side: +1 left, -1 right. 0: nothing is searched for.
  void KeepTo(int side) { side_ = side; }

  // Is told that a hazard was felt in a turn to that side: a search goes on the other way round.
  void Feel(int side);
  // Returns a turn to the same heading the way round on which none was felt since the last drive; 0
  // where one was on both.
  double Round_rad(double turn_rad) const;

  void Count(double turned_rad);

  // The rover drives, or what it has seen is forgotten: all ground may be searched again.
  void ForgetGround();

  // Is told that there is a next goal: the search is over, and all ground may be searched.
  void Restart();

 private:
  double search_turn_rad_;
  double step_rad_;
  double turned_rad_ = 0.0;  // since the last drive
  int side_ = 0;
  bool felt_left_ = false;
  bool felt_right_ = false;
};

}  // namespace rockyard::navigation
