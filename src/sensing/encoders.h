// Wheel encoders: increments of the six wheel angles over one on-board tick.
//
// The published growth of the distance error on level sand (Matthies 1995, section 5: 0.0039 m2/m)
// is modelled as that section does: the motion of each stretch of 6.7 cm is wrong by an independent
// normal amount. Within a stretch the error grows in proportion to the motion, as a scale error,
// so that neither the tick length nor a pause changes it and measured motion does not run backwards
// (the scale error of a stretch has a standard deviation of 24 %; white noise per tick would exceed
// the motion of a tick). All wheels share it: independent noise of six wheels would need six times
// the variance for the same effect, and the paper names the slip of the rover as the cause. A turn
// in place has no mean motion and gets none.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "messages/wheels.h"
#include "sensing/encoder_params.h"

namespace rockyard::sensing {

// The encoders of the six wheels over one trial.
class Encoders {
 public:
  // wheel_radius_m is the true radius, which turns wheel angle into travel.
  Encoders(const EncoderParams& params, double wheel_radius_m, core::TrialKey key);

  // Returns the measured increments for the next true ones, radians, positive forward. The scale
  // error of the n-th stretch of travel comes from stream kEncoder, substream n.
  messages::PerWheel<double> Measure(const messages::PerWheel<double>& true_turn_rad);

 private:
  // Travels on and returns the distance error of that travel.
  double RollOn(double distance_m);

  EncoderParams params_;
  double wheel_radius_m_;
  core::TrialKey key_;
  std::uint32_t stretch_ = 0;  // number of the present stretch
  double left_in_stretch_m_ = 0.0;
  double scale_error_ = 0.0;  // of the present stretch
};

}  // namespace rockyard::sensing
