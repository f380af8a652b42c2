// How the error of dead reckoning grows over a stretch of some ticks: the error-state filter
// gathers it tick by tick and hands it to its covariance at the end of the stretch. Records
// depend on these sums only where that filter is the estimator.
//
// The believed increments are dr = dr_wheels (1 + w) and dh = (turn - b dt) / k, with gyro bias b,
// gyro scale k and wheel scale 1 + w; the step is driven along a = h + share dh (share 1/2: middle
// of the step, 0: its start). The errors go on as
//   dh:  e_h += -dt/k e_b - dh/k e_k + n_h
//   x:   e_x += -dr sin(a) e_a + cos(a) (dr / (1 + w) e_w + n_r),   e_a = e_h + share (step of e_h)
//   y:   e_y +=  dr cos(a) e_a + sin(a) (dr / (1 + w) e_w + n_r)
//   z:   e_z += -dr cos(p) e_p - sin(p) dr / (1 + w) e_w + n_z
//   tilt: e_roll, e_p <- c e + n_t
// (Matthies 1995, section 5, linearized about what is believed). The tilt's error is a first-order
// Gauss-Markov process along the way: accelerometers tell the tilt anew everywhere, but
// neighbouring places have much in common. The error after the stretch is F e + n with covariance N
// of n. F and N are exact to first order for any number of ticks, but for the tilt's noise at both
// ends of a tick.
#pragma once

#include "localization/error_state.h"

namespace rockyard::localization {

// One tick of believed motion.
struct MotionTick {
  double forward_m = 0.0;    // dr
  double turn_rad = 0.0;     // dh
  double along_rad = 0.0;    // a
  double turn_share = 0.5;   // of dh that is in a
  double pitch_rad = 0.0;    // p, positive with the nose down
  double duration_s = 0.0;   // dt
  double gyro_scale = 1.0;   // k
  double wheel_scale = 1.0;  // 1 + w
};

// Variances that one tick adds.
struct TickNoise {
  double heading_rad2 = 0.0;  // of n_h
  double distance_m2 = 0.0;   // of n_r
  double height_m2 = 0.0;     // of n_z
  double bias_rad2_s2 = 0.0;  // of the gyro's bias, a random walk
  double tilt_kept = 1.0;     // c
  double tilt_rad2 = 0.0;     // variance of the tilt's error where it is stationary
};

// F and N of the ticks since Restart.
class ErrorStretch {
 public:
  ErrorStretch() { Restart(); }

  void Add(const MotionTick& tick, const TickNoise& noise);
  void Restart();

  const ErrorMatrix& transition() const { return transition_; }  // F
  const ErrorMatrix& noise() const { return noise_; }            // N
  double way_m() const { return way_m_; }                        // sum of |dr|
  bool empty() const { return empty_; }

 private:
  ErrorMatrix transition_;
  ErrorMatrix noise_;
  double way_m_ = 0.0;
  bool empty_ = true;
};

}  // namespace rockyard::localization
