// Gyro and encoders together: from the course of the true state to motion measurements.
#pragma once

#include <cstdint>

#include "messages/measurements.h"
#include "sensing/encoders.h"
#include "sensing/gyro.h"
#include "sensing/scrape_detector.h"
#include "truth/rover_state.h"

namespace rockyard::sensing {

// Gyro, encoders and scrapes of one trial.
class MotionSensors {
 public:
  // Starts at `state`. wheel_radius_m is the true radius, m.
  MotionSensors(const GyroParams& gyro, const EncoderParams& encoders, double wheel_radius_m,
                core::TrialKey key, const truth::RoverState& state);

  // Is called once a physics step and watches for scrapes.
  void Observe(const truth::RoverState& state, double time_s);

  // Is called once an on-board tick and returns what was measured since the last tick. `moving`
  // says that the rover was told to move. Ticks are numbered from 0, which indexes the noise of the
  // gyro.
  messages::MotionMeasurement Measure(const truth::RoverState& state, double duration_s,
                                      bool moving);

  // Starts anew at `state`, after operators moved the rover by hand with its sensors switched off:
  // what lies between is not measured.
  void Restart(const truth::RoverState& state);

  const ScrapeDetector& scrapes() const { return scrapes_; }

 private:
  Gyro gyro_;
  Encoders encoders_;
  ScrapeDetector scrapes_;
  math::Transform X_WR_;
  messages::PerWheel<double> wheel_angle_rad_;
  double pending_jump_rad_ = 0.0;
  std::int64_t tick_ = 0;
};

}  // namespace rockyard::sensing
