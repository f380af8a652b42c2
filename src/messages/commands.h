// Commands: what a navigator asks for, and what the wheels are told.
#pragma once

#include "messages/wheels.h"

namespace rockyard::messages {

enum class MotionKind {
  kStop,
  kArc,          // drive along a circular arc (curvature 0: straight)
  kTurnInPlace,  // rotate about the chassis centre
};

// A motion that lasts until the next command. On-board code ends it by what it measures.
struct MotionCommand {
  MotionKind kind = MotionKind::kStop;
  double curvature_per_m = 0.0;  // kArc: positive turns left
  int direction = 1;             // kArc: +1 forward, -1 backward; kTurnInPlace: +1 left, -1 right
};

// Set points of the drive and steering motors, held until the next command.
struct WheelCommand {
  PerWheel<double> rate_rad_s{};  // positive rolls forward
  PerWheel<double> steer_rad{};   // positive steers left (about +z)
};

}  // namespace rockyard::messages
