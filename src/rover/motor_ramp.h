// How the drive motors come from one set point to the next: both fidelities drive their wheels by
// it. Records depend on the order of its sums. Advance goes on from its last call, and is called
// once for each step, or each part into which the multibody divides one.
#pragma once

#include "messages/wheels.h"
#include "rover/rover_params.h"

namespace rockyard::rover {

// The rates, rad/s, at which the motors are driven within one step: linear from `from` to `to`.
// Where a ramp ends within the step, `from` is chosen so that the mean rate of the step is that of
// the ramp; without a ramp it equals `to`.
struct MotorRates {
  messages::PerWheel<double> from{};
  messages::PerWheel<double> to{};
};

// Lets the rates of the motors follow the commanded rates with a bounded acceleration, so that a
// wheel comes from rest to the top speed, or back, in drive.ramp_s. All wheels arrive together: the
// wheel with the farthest to go takes the full acceleration, and the changes of the others keep
// their ratio to it, so that a rover that starts turns about the same centre as one that drives on.
// With a ramp of 0 the rates jump.
class MotorRamp {
 public:
  explicit MotorRamp(const RoverParams& params);

  // Stops the motors at once.
  void Reset() { rate_rad_s_.fill(0.0); }

  // Returns the rates of the next step of `step_s`. Where physics.time_scale makes the motion
  // faster, step_s is time of the physics while the rates are those of real time.
  MotorRates Advance(const messages::PerWheel<double>& commanded_rad_s, double step_s);

 private:
  double acceleration_rad_s2_;  // infinite without a ramp
  messages::PerWheel<double> rate_rad_s_{};
};

}  // namespace rockyard::rover
