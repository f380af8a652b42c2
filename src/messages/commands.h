/// @file
/// Commands: navigators ask for motions, the wheel driver makes set points of them, and the
/// simulated rover follows the set points.
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

/// A motion that lasts until the next command. On-board code ends it by what it measures. Must
/// stay: every member takes part in ==, by which the counting of moves tells a repeated command
/// from a new one.
struct MotionCommand {
  MotionKind kind = MotionKind::kStop;
  double curvature_per_m = 0.0;  ///< kArc: where the command is first given; positive turns left
  int direction = 1;             ///< kArc: +1 forward, -1 backward; kTurnInPlace: +1 left, -1 right
  /// kArc: by how much the curvature grows with each metre driven since the command was first
  /// given; a clothoid where it is not 0.
  double curvature_rate_per_m2 = 0.0;
  double speed_share = 1.0;  ///< of the rover's full speed, above 0 to 1
  /// kArc: the reading of the odometer, m, at which the rover has come to rest where no other
  /// command follows: the end of the way that its plan was judged for.
  double end_m = std::numeric_limits<double>::infinity();
  /// The number of the move. Successive commands with the same number other than 0 are one move,
  /// however they differ. With 0 each command that differs from the last one is a move.
  std::int64_t move = 0;

  bool operator==(const MotionCommand&) const = default;
};

/// Set points of the drive and steering motors, held until the next command.
struct WheelCommand {
  PerWheel<double> rate_rad_s{};  ///< positive rolls forward
  PerWheel<double> steer_rad{};   ///< positive steers left (about +z)
  /// How long these set points hold, s, where others are known to follow: one tick along a
  /// clothoid. The quasi-static rover plans no farther ahead.
  double held_s = std::numeric_limits<double>::infinity();
};

}  // namespace rockyard::messages
