// What dead reckoning lives on: gyro, encoders, and scrapes that shake the gyro. The world of a
// drive measures with them once an on-board tick; results count the scrapes. Records of drives
// depend on the numbers that name draws: tick, stretch, episode. Observe must see every step of a
// tick before Measure ends it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "math/pose.h"
#include "messages/measurements.h"
#include "messages/wheels.h"
#include "sensing/motion_sensor_params.h"
#include "truth/rover_state.h"

namespace rockyard::sensing {

// The turn-rate gyro of one trial: integrated rate about the rover's own z axis over one on-board
// tick.
//
// measured = scale * true turn + bias duration + noise + scrape jumps, with noise ~ N(0, q
// duration) and a bias drawn once a trial, while the rover moves (and at rest if so chosen): a
// random walk of the heading in time. q follows from the growth per metre on level sand at a known
// speed (Matthies 1995, section 5), so that a slower rover drifts more per metre. The paper's
// straight runs measure q; the scale comes from its turns (section 8).
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

// The wheel encoders of one trial: increments of the six wheel angles over one on-board tick.
//
// The published growth of the distance error on level sand (Matthies 1995, section 5: 0.0039 m2/m)
// is modelled as that section does: the motion of each stretch of 6.7 cm is wrong by an independent
// normal amount. Within a stretch the error grows in proportion to the motion, as a scale error,
// so that neither the tick length nor a pause changes it and measured motion does not run backwards
// (the scale error of a stretch has a standard deviation of 24 %; white noise per tick would exceed
// the motion of a tick). All wheels share it: independent noise of six wheels would need six times
// the variance for the same effect, and the paper names the slip of the rover as the cause. A turn
// in place has no mean motion and gets none.
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

// Scrapes of one trial against rocks and what they do to the measured heading: about 5 degrees at
// once (Matthies 1995, sections 5 and 8; the paper suspects vibration of the gyro).
//
// Trigger: a part of the body (hub, belly, rocker, panel edge; not a wheel) presses on a rock with
// at least min_force while sliding at min_sliding_speed or more. One jump per episode: an episode
// with a rock ends when the rover has not scraped that rock for episode_gap_s and has moved
// episode_gap_m since. Size and sign of the jump of the n-th episode, from 0, come from stream
// kScrapeJump, substream n.
class ScrapeDetector {
 public:
  ScrapeDetector(const ScrapeParams& params, core::TrialKey key) : params_(params), key_(key) {}

  // Looks at one physics step, in order of time. Returns the sum of the jumps that begin with it,
  // radians, positive left; 0 for nearly every step. With params.enabled false, episodes are
  // counted and nothing jumps.
  double Observe(const truth::RoverState& state, double time_s);

  std::int64_t episodes() const { return episodes_; }
  double total_jump_rad() const { return total_jump_rad_; }  // sum of signed jumps

 private:
  struct Episode {
    int rock;
    double last_time_s;
    math::Vector3 last_position_W;
  };

  bool IsScrape(const truth::BodyContact& contact) const;
  bool BeginsEpisode(int rock, double time_s, const math::Vector3& position_W);
  double Jump() const;

  ScrapeParams params_;
  core::TrialKey key_;
  std::vector<Episode> known_;  // latest scrape of each rock
  std::int64_t episodes_ = 0;
  double total_jump_rad_ = 0.0;
};

// Gyro, encoders and scrapes of one trial. Steering angles are told without error.
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
