// Whether the rover gets on, from what its wheels are told and what it measures. The on-board side
// of a drive asks every tick and reacts as navigation.on_board_stuck says; no other record depends
// on it. Ticks at rest neither count nor end a window. Wheel odometry cannot tell: wheels that spin
// measure a drive. Two signs are looked for, each over window_s of commanded motion:
//
//   no turn: the wheels were told to turn the rover by min_told_turn or more, and the gyro has
//            measured less than min_turn_share of that, the way it was told;
//   strain:  strained_wheels drive motors or more have each measured strain_current for
//            strain_share of the window, where the rover measures its motor currents
//            (sensors.vehicle).
//
// The turn rate w that the wheels are told comes from least squares over all wheels. With u_i the
// forward speed of wheel i's rim and y_i its place, u_i = v - w y_i about any common centre of
// rotation, so that w is the slope of u over -y. The told turn is the sum of |w| dt, the obeyed
// turn the sum of the gyro's turns with the sign of w: neither cancels where the rover is told to
// turn to and fro.
//
// Limits: a rover that is told to drive straight and has no motor currents notices nothing. Nor
// does a rover whose wheels spin on ground so loose that they do not strain, or that turns on the
// spot while told an arc. Climbing a slope that strains most motors for a window looks like being
// stuck. All of this is assumed; neither Matthies 1995 nor Goldberg 2002 has such a rule.
#pragma once

#include <optional>

#include "messages/calibration.h"
#include "messages/commands.h"
#include "messages/measurements.h"
#include "messages/vehicle_state.h"
#include "perception/stuck_detector_params.h"

namespace rockyard::perception {

// By what the rover notices that it is stuck.
enum class StuckSign { kNoTurn, kStrain };

// Returns the turn rate that steady wheels of this command give the rover, rad/s, positive left.
double ToldTurnRate(const messages::WheelCommand& command,
                    const messages::DriveCalibration& calibration);

// Looks at one window of commanded motion after the other.
class StuckDetector {
 public:
  StuckDetector(const StuckDetectorParams& params, const messages::DriveCalibration& calibration)
      : params_(params), calibration_(calibration) {}

  // Takes one on-board tick: what the wheels were told, and what was measured meanwhile. Returns a
  // sign at the end of a window in which the rover did not get on; kNoTurn goes before kStrain.
  std::optional<StuckSign> Observe(const messages::WheelCommand& command,
                                   const messages::MotionMeasurement& motion,
                                   const messages::VehicleState& felt);

  // Is called where operators moved the rover by hand: begins a window anew.
  void Restart() { window_ = {}; }

 private:
  struct Window {
    double duration_s = 0.0;
    double told_rad = 0.0;    // sum of magnitudes
    double obeyed_rad = 0.0;  // by the gyro, the way it was told
    messages::PerWheel<double> strained_s{};
  };

  std::optional<StuckSign> SignOf(const Window& window) const;

  StuckDetectorParams params_;
  messages::DriveCalibration calibration_;
  Window window_;
};

}  // namespace rockyard::perception
