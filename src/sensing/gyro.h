// The turn-rate gyro: integrated rate about the rover's own z axis over one on-board tick.
//
// measured = scale * true turn + bias duration + noise + scrape jumps, with noise ~ N(0, q
// duration) and a bias drawn once a trial, while the rover moves (and at rest if so chosen): a
// random walk of the heading in time. q follows from the growth per metre on level sand at a known
// speed (Matthies 1995, section 5), so that a slower rover drifts more per metre. The paper's
// straight runs measure q; the scale comes from its turns (section 8).
#pragma once

#include <cstdint>

#include "core/random.h"
#include "math/pose.h"
#include "sensing/gyro_params.h"

namespace rockyard::sensing {

// The gyro of one trial.
class Gyro {
 public:
  Gyro(const GyroParams& params, core::TrialKey key);

  // Returns the noisy turn of tick `step`, radians, positive left. The noise depends on the key,
  // the step and the duration alone (stream kGyro, substream step).
  double Measure(double true_turn_rad, double duration_s, bool moving, std::int64_t step) const;

 private:
  GyroParams params_;
  core::TrialKey key_;
  double bias_rad_s_ = 0.0;
};

// Returns the rotation about the rover's z axis between two poses a short tick apart, radians: the
// z component of the rotation vector. On level ground it is the change of heading.
double TurnAboutOwnAxis(const math::Transform& X_WR_before, const math::Transform& X_WR_after);

}  // namespace rockyard::sensing
