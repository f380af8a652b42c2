/// @file
/// Commands: what a navigator asks for, and what the wheels are told.
#pragma once

#include <cstdint>
#include <limits>

#include "messages/wheels.h"

namespace rockyard::messages {

/// What kind of motion a command asks for.
enum class MotionKind {
  kStop,         ///< stand
  kArc,          ///< drive along a circular arc (curvature 0: straight)
  kTurnInPlace,  ///< rotate about the chassis centre
};

/// A motion that lasts until the next command. On-board code ends it by what it measures. Every
/// member takes part in ==, by which a repeated command is told from a new move.
struct MotionCommand {
  MotionKind kind = MotionKind::kStop;
  double curvature_per_m = 0.0;  ///< kArc: positive turns left; where the command is first given
  int direction = 1;             ///< kArc: +1 forward, -1 backward; kTurnInPlace: +1 left, -1 right
  /// kArc: what the curvature grows by with each metre driven since, a clothoid where it is not 0.
  double curvature_rate_per_m2 = 0.0;
  double speed_share = 1.0;  ///< of the rover's full speed, above 0 to 1
  /// kArc: the odometer, m, at which the rover has come to rest, whatever is asked of it: the end
  /// of what its plan was judged for.
  double end_m = std::numeric_limits<double>::infinity();
  /// Commands in a row with one number other than 0 are one move, however they differ. With 0 each
  /// command that differs from the last one is a move.
  std::int64_t move = 0;

  bool operator==(const MotionCommand&) const = default;
};

/// Set points of the drive and steering motors, held until the next command.
struct WheelCommand {
  PerWheel<double> rate_rad_s{};  ///< positive rolls forward
  PerWheel<double> steer_rad{};   ///< positive steers left (about +z)
  /// When others are known to follow, s: the next tick, along a clothoid. The quasi-static rover
  /// plans no farther ahead than this.
  double held_s = std::numeric_limits<double>::infinity();
};

}  // namespace rockyard::messages
