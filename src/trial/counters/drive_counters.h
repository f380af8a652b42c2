// What the observer of a drive counts and adds up. Records depend on it: each class defines columns
// of truth/drive_record.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/check.h"
#include "messages/commands.h"
#include "messages/wheels.h"

namespace rockyard::trial {

// How often the rover was told to turn in place.
class TurnCounter {
 public:
  // Takes what the navigator told, at each decision that is no look at rest: a turn goes on across
  // looks. A turn the other way round is another turn.
  void Observe(const messages::MotionCommand& motion) {
    const bool turning = motion.kind == messages::MotionKind::kTurnInPlace;
    const int direction = turning ? motion.direction : 0;
    if (turning && direction != direction_) ++turns_;
    direction_ = direction;
  }

  std::int64_t turns() const { return turns_; }

 private:
  int direction_ = 0;  // of the turn under way, 0 without one
  std::int64_t turns_ = 0;
};

// A move is one motion command, held until another one follows or the rover looks: an arc, or a
// turn in place. Where a navigator numbers its moves, its number tells one from the next instead:
// looks, and curvatures that change at each tick, belong to the move under way.
class MoveCounter {
 public:
  // Takes what the navigator told, at each decision that is no look at rest. Returns whether a move
  // begins.
  bool Observe(const messages::MotionCommand& motion) {
    const bool same = motion.move != 0 ? motion.move == last_.move : moving_ && motion == last_;
    moving_ = motion.kind != messages::MotionKind::kStop;
    last_ = motion;
    if (same || !moving_) return false;
    ++moves_;
    if (motion.kind == messages::MotionKind::kTurnInPlace) {
      ++point_turns_;
    } else {
      if (motion.direction == -way_) ++reversals_;
      way_ = motion.direction;
    }
    return true;
  }
  void OnLook() { moving_ = false; }

  std::int64_t moves() const { return moves_; }
  std::int64_t point_turns() const { return point_turns_; }
  // Returns how many arcs were driven the other way than the last arc before, whatever lay between.
  std::int64_t reversals() const { return reversals_; }

 private:
  messages::MotionCommand last_;
  bool moving_ = false;
  std::int64_t moves_ = 0;
  int way_ = 0;  // of the last arc, 0 before the first
  std::int64_t point_turns_ = 0;
  std::int64_t reversals_ = 0;
};

// A stop is the end of a stretch of driving or turning: for a look, to steer the wheels at rest,
// for the overhead of a move, or because the trial is over.
class StopCounter {
 public:
  // Takes one control tick; `moving` while the wheels are told to drive or to turn the rover.
  void Observe(bool moving) {
    if (moving_ && !moving) ++stops_;
    moving_ = moving;
  }

  // Returns the stops, with the stop that the end of the drive makes of a rover that still moves.
  std::int64_t stops() const { return stops_ + (moving_ ? 1 : 0); }

 private:
  bool moving_ = false;
  std::int64_t stops_ = 0;
};

// The total turning of each steering motor, to and fro alike:
//   sum over ticks of |angle - angle before|,
// in truth. Within a tick the motors go one way, so that nothing of their turning is missed. Howard
// 2012, section 3, compares navigators by its mean over the motors ("average aggregate displacement
// of a single steering motor").
class SteerCounter {
 public:
  // At least one wheel is steered.
  explicit SteerCounter(const messages::PerWheel<bool>& steered) : steered_(steered) {
    EXPECT(std::count(steered.begin(), steered.end(), true) > 0);
  }

  // Starts, or starts again with wheels that were turned by hand: that turning does not count.
  void Restart(const messages::PerWheel<double>& steer_rad) { last_rad_ = steer_rad; }

  // Takes the true angles after one control tick.
  void Observe(const messages::PerWheel<double>& steer_rad) {
    for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
      if (steered_[i]) turned_rad_[i] += std::abs(steer_rad[i] - last_rad_[i]);
    }
    last_rad_ = steer_rad;
  }

  // Returns the mean over the steered wheels.
  double mean_rad() const {
    double sum_rad = 0.0;
    for (const double turned_rad : turned_rad_) sum_rad += turned_rad;
    return sum_rad / static_cast<double>(std::count(steered_.begin(), steered_.end(), true));
  }

  // Returns the turning of the motor that turned most.
  double max_rad() const { return *std::max_element(turned_rad_.begin(), turned_rad_.end()); }

 private:
  messages::PerWheel<bool> steered_;
  messages::PerWheel<double> last_rad_{};
  messages::PerWheel<double> turned_rad_{};  // 0 of wheels that are not steered
};

// Looks whose hazard was believed, and hazards that began. A rover that turns away from a hazard
// scans it again and again. A hazard begins where one is believed and the look before saw none,
// which is once for each time that the rover avoids.
class HazardCounter {
 public:
  // Takes one look; `believed`: its report names a hazard.
  void Observe(bool believed) {
    if (believed) {
      ++believed_;
      if (!avoiding_) ++begun_;
    }
    avoiding_ = believed;
  }

  std::int64_t believed() const { return believed_; }
  std::int64_t begun() const { return begun_; }

 private:
  bool avoiding_ = false;
  std::int64_t believed_ = 0;
  std::int64_t begun_ = 0;
};

// Slope of the squared error e^2 against the true distance x, by least squares through the origin
// over the whole path: (sum of x e^2 dx) / (sum of x^2 dx), in the unit of e squared a metre. Where
// e is a random walk the mean over runs is its variance a metre. It is linear in e^2, so that the
// mean over runs of equal length is the slope of the line fitted to their error variance, which
// Matthies 1995 sec. 5 reads off twenty runs (fig. 5).
class ErrorGrowth {
 public:
  // Takes the error after `distance_m` of true way, which never falls. It counts only where the way
  // has grown.
  void Observe(double distance_m, double error) {
    const double weight_m2 = distance_m * (distance_m - last_m_);
    moment_ += weight_m2 * error * error;
    weight_m3_ += weight_m2 * distance_m;
    last_m_ = distance_m;
  }

  // Returns the slope; 0 where there was no way.
  double per_m() const { return weight_m3_ > 0.0 ? moment_ / weight_m3_ : 0.0; }

 private:
  double last_m_ = 0.0;
  double moment_ = 0.0;
  double weight_m3_ = 0.0;
};

}  // namespace rockyard::trial
