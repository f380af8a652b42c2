// Wheel encoders: increments of the six wheel angles over one on-board tick.
//
// The published growth of the distance error on level sand (Matthies 1995, section 5: 0.0039 m2/m)
// is taken as a random walk in distance that all wheels share: a forward increment ds, the mean
// over the wheels, is disturbed by N(0, v |ds|) with v what wheel slip in the physics leaves to
// add. The wheels share it because independent noise of six wheels would need six times the
// variance for the same effect, and the paper names wheel slip of the whole rover as the cause. A
// turn in place has ds = 0 and gets none.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "messages/wheels.h"
#include "sensing/encoder_params.h"

namespace rockyard::sensing {

class Encoders {
 public:
  // wheel_radius_m is the true radius, which turns metres of noise into wheel angle.
  Encoders(const EncoderParams& params, double wheel_radius_m, core::TrialKey key);

  // Measured increments of tick `step` for the true ones, radians, positive forward. The noise
  // depends on key, step and mean increment alone (stream kEncoder, substream step).
  messages::PerWheel<double> Measure(const messages::PerWheel<double>& true_turn_rad,
                                     std::int64_t step) const;

 private:
  double noise_variance_m2_per_m_;
  double wheel_radius_m_;
  core::TrialKey key_;
};

}  // namespace rockyard::sensing
