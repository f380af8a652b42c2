// Gyro and encoders together: from the course of the true state to motion measurements.
#pragma once

#include <cstdint>

#include "messages/measurements.h"
#include "sensing/encoders.h"
#include "sensing/gyro.h"
#include "sensing/scrape_detector.h"
#include "truth/rover_state.h"

namespace rockyard::sensing {

class MotionSensors {
 public:
  // Starts at `state`. wheel_radius_m is the true radius.
  MotionSensors(const GyroParams& gyro, const EncoderParams& encoders, double wheel_radius_m,
                core::TrialKey key, const truth::RoverState& state);

  // Once a physics step: watches for scrapes.
  void Observe(const truth::RoverState& state, double time_s);

  // Once an on-board tick: what was measured since the last tick. `moving`: the rover was told to
  // move. Ticks are numbered from 0, which indexes the noise of the gyro.
  messages::MotionMeasurement Measure(const truth::RoverState& state, double duration_s,
                                      bool moving);

  // Operators moved the rover by hand with its sensors switched off: what lies between is not
  // measured.
  void Resume(const truth::RoverState& state);

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
